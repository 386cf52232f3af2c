// SPDX-License-Identifier: MIT
#include "compare/render/reference_frame.h"

#include "compare/files/output.h"
#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/metrics/channel.h"
#include "compare/reference/reference.h"
#include "compare/render/host_memory.h"
#include "compare/render/omitted_lights.h"
#include "compare/run/interruption.h"
#include "compare/run/progress.h"
#include "compare/run/version.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/text/open_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// 99.9th percentile of the relative uncertainty over pixels that show a surface.
double uncertaintyOf(const Image& uncertainty, const Image& image, const Coverage& covered) {
    const PixelError error(ErrorKind::relative, ChannelKind::color, image, covered);
    std::vector<double> all;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const float* p = image.pixel(i);
        const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        all.push_back(double{uncertainty.pixel(i)[0]} / std::max(largest, error.floor()));
    }
    if (all.empty()) return 0;
    const auto rank = static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(all.size()))) - 1;
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(rank));
    return all[rank];
}

glm::dvec3 doubles(const Rgb& c) {
    return {double{c.r}, double{c.g}, double{c.b}};
}

// Empty without haze. Aerosols absorb a tenth of their extinction.
std::optional<reference::Air> airOf(const std::vector<Light>& lights, const Settings& settings) {
    if (!settings.haze || settings.haze_density == 0) return {};
    const double density = double{settings.haze_density};
    const glm::dvec3 molecules = doubles(settings.haze_rayleigh) * density,
                     aerosols = doubles(settings.haze_mie) * density;
    const std::optional<std::size_t> sun = brightestSun(lights);
    return reference::Air{.molecules = {molecules, molecules, double{settings.haze_rayleigh_height}},
                          .aerosols = {aerosols, aerosols / 0.9, double{settings.haze_mie_height}},
                          .g = double{settings.haze_g},
                          .ground = double{settings.haze_ground},
                          .uniform = settings.haze_march_steps == 0,
                          .sun = sun ? &lights[*sun] : nullptr,
                          .ambient = doubles(settings.ambient)};
}

bool isLitFromEverywhere(const Scene& scene, const Settings& settings) {
    const Rgb& ambient = settings.ambient;
    return (scene.environment && settings.ibl_intensity > 0) ||
           std::max({ambient.r, ambient.g, ambient.b}) > 0;
}

// `surroundings`: W x H x 2, light and its occluded part; empty if there is none.
std::optional<Frame::HiddenLight> hiddenLight(const Image& surroundings) {
    double all = 0, hidden = 0, above = 0;
    std::vector<double> fractions;
    for (std::size_t i = 0; i < surroundings.pixels(); ++i) {
        const float* const p = surroundings.pixel(i);
        if (!(p[0] > 0)) continue;
        all += double{p[0]};
        hidden += double{p[1]};
        fractions.push_back(double{p[1]} / double{p[0]});
        above += fractions.back() > 0.1;
    }
    if (fractions.empty()) return {};
    const auto count = static_cast<double>(fractions.size());
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.99 * count)) - 1;
    std::ranges::nth_element(fractions, fractions.begin() + rank);
    return Frame::HiddenLight{hidden / all, fractions[static_cast<std::size_t>(rank)], above / count};
}

std::string hiddenLightNote(const Frame::HiddenLight& hidden) {
    return fmt::format(
        "geometry would block {:.3g} % of the environment and ambient light in lit, which neither path "
        "models: over 10 % at {:.3g} % of the pixels, 99th percentile {:.3g} %",
        100 * hidden.mean, 100 * hidden.pixels, 100 * hidden.p99);
}

// The inputs that determine every pixel.
reference::Request requestOf(const Scene& scene, const SceneView& view, const Settings& settings,
                             const Frame* surfaces) {
    return {.scene = scene,
            .pose = view.pose,
            .view = view.view,
            .lights = view.lights,
            .residual = view.environment == view.background ? nullptr : view.environment,
            .environment_factor = double{settings.ibl_intensity},
            .environment_rotation = glm::radians(double{settings.env_rotation}),
            .ambient = doubles(settings.ambient),
            .multiscatter = settings.multiscatter,
            .base_layer = settings.base_layer,
            .skin_normals = settings.skin_normals,
            .falloff = {settings.range_window, settings.spot_cone},
            .air = airOf(view.lights, settings),
            .blended = settings.transparency != Transparency::off,
            .casters = settings.shadows == Shadows::off ? std::vector<std::size_t>{}
                                                        : castingLights(view.lights, settings.shadow_lights),
            .mode = settings.reference_mode,
            .samples = settings.spp,
            .resolve = settings.resolve,
            .surfaces = surfaces ? &surfaces->channels : nullptr};
}

// Moves the reference's images into the Frame, with notes on what they show.
void takeImage(reference::ReferenceImage& rendered, Frame& frame) {
    frame.counters.nonfinite_pixels = nonfinitePixels(rendered.channels.at(Channel::lit));
    frame.channels = std::move(rendered.channels);
    for (auto& [channel, image] : frame.channels)
        if (auto repaired = replaceNonfinite(image); !repaired.empty())
            frame.repaired[channel] = std::move(repaired);
    frame.through_gbuffer = std::move(rendered.decoded);
    frame.rounding = std::move(rendered.rounding);
    frame.shadow_edge = std::move(rendered.shadow_edge);
    frame.local_shadow_edge = std::move(rendered.local_shadow_edge);
    frame.blended = std::move(rendered.blended);
    frame.unblended = std::move(rendered.unblended);
    frame.environment_costs = std::move(rendered.environment_costs);
    if (!rendered.surroundings.empty()) {
        frame.hidden_light = hiddenLight(rendered.surroundings);
        if (frame.hidden_light) frame.notes.push_back(hiddenLightNote(*frame.hidden_light));
    }
    if (!rendered.uncertainty.empty()) {
        frame.relative_uncertainty =
            uncertaintyOf(rendered.uncertainty, frame.channels.at(Channel::lit), coverage(frame, frame));
        frame.uncertainty = std::move(rendered.uncertainty);
        frame.notes.push_back(uncertaintyNote(frame.relative_uncertainty));
    }
}

}  // namespace

reference::PixelLight drawReferencePixel(const Scene& scene, const SceneView& view, const Settings& settings,
                                         const Frame* surfaces, int x, int y) {
    return reference::drawPixel(requestOf(scene, view, settings, surfaces), x, y);
}

Frame drawReferenceFrame(const Scene& scene, const SceneView& view, const Settings& settings,
                         const Frame* surfaces, const RenderOptions& options, const Frame* decoded) {
    const auto start = std::chrono::steady_clock::now();
    std::string step = settings.reference_mode == ReferenceMode::surface ? "reference: shade every surface"
                                                                         : "reference: trace every pixel";
    reference::Request request = requestOf(scene, view, settings, surfaces);
    request.decoded = decoded ? &decoded->channels : nullptr;
    request.environment_costs = options.environment_errors && scene.environment && settings.ibl_intensity > 0;
    request.surroundings = options.environment_errors && isLitFromEverywhere(scene, settings);
    request.shadow_edges = options.shadow_edges;
    request.keep = options.keep;
    request.program = commitName();
    request.progress = [&](double fraction) { options.progress.at(fraction, step); };
    if (options.tile)
        request.tile = [&](const reference::ReferenceImage& rendered, int x, int y, int width, int height) {
            options.tile(rendered.channels, x, y, width, height);
        };
    // Called before any tile is rendered.
    request.expected = [&](double seconds) {
        step += fmt::format(", about {} in all", clockText(seconds));
        options.progress.at(0, step);
    };
    reference::ReferenceImage rendered = reference::draw(request);

    Frame frame = describedFrame(scene, view, settings);
    frame.requested = options.requested;
    takeImage(rendered, frame);
    const auto isUnwanted = [&](Channel channel) {
        return std::ranges::count(options.channels, channel) == 0 ||
               isOmitted(options, view.needs.layers, channel);
    };
    std::erase_if(frame.channels, [&](const auto& entry) {
        return isUnwanted(entry.first) && entry.first != Channel::material_id;
    });
    std::erase_if(frame.through_gbuffer, [&](const auto& entry) { return isUnwanted(entry.first); });
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (rendered.resumed_fraction > 0)
        frame.notes.push_back(fmt::format(
            "the reference resumed at {:.0f} %, which an interrupted command had rendered in {}; the rest "
            "took {}",
            std::floor(100 * rendered.resumed_fraction), clockText(rendered.resumed_seconds),
            clockText(now)));
    frame.made_in_ms = 1000 * (now + rendered.resumed_seconds) + (surfaces ? surfaces->made_in_ms : 0);
    return frame;
}

bool needsDevice(const Settings& settings) {
    return !isReference(settings.path) || settings.reference_mode != ReferenceMode::scene;
}

std::vector<Frame> drawWithoutDevice(SceneViews& views, const std::vector<Settings>& settings,
                                     const RenderOptions& options) {
    checkHostMemory(views, settings, options, false);
    std::vector<Frame> frames;
    const auto count = static_cast<double>(settings.size());
    for (const Settings& each : settings) {
        RenderOptions drawing = options;
        const auto done = static_cast<double>(frames.size());
        drawing.progress = options.progress.part(done / count, (done + 1) / count);
        frames.push_back(
            drawReferenceFrame(views.scene(), views.at(viewRequest(each)), each, nullptr, drawing));
    }
    return frames;
}

std::vector<Frame> drawWithoutDevice(const Scene& scene, const std::vector<Settings>& settings,
                                     const RenderOptions& options) {
    SceneViews views(scene);
    return drawWithoutDevice(views, settings, options);
}

ReferenceCheckpoints::ReferenceCheckpoints(const fs::path& output, bool isFolder)
    : stem_(besideOutput(output, "reference")), is_folder_(isFolder) {}

reference::Checkpoint& ReferenceCheckpoints::open(std::uint64_t key, std::size_t floats) {
    if (is_folder_) OpenFolder::made(stem_.parent_path());  // Checkpoint reports a failure
    checkpoints_.push_back(std::make_unique<reference::Checkpoint>(stem_, key, floats));
    setInterruptionMessage(
        fmt::format("the finished part of the reference is kept in {}: the same command resumes there",
                    checkpoints_.back()->file().string()));
    return *checkpoints_.back();
}

void ReferenceCheckpoints::remove() {
    setInterruptionMessage({});
    for (const auto& checkpoint : checkpoints_) checkpoint->remove();
}

std::string ReferenceCheckpoints::leftByOthers() const {
    std::vector<std::string> files;
    for (const fs::path& file : reference::abandonedCheckpoints(stem_)) files.push_back(file.string());
    if (files.empty()) return {};
    return fmt::format(
        "kept from other interrupted references: {}; the same command resumes from its file; remove files "
        "that you do not need",
        fmt::join(files, ", "));
}

}  // namespace diptych
