// SPDX-License-Identifier: MIT
#include "compare/audit/measure.h"

#include "compare/experiment/errors.h"
#include "compare/experiment/row_checkpoint.h"
#include "compare/frames/frame_properties.h"
#include "compare/image/channel_image.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/flip.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/model/material_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <future>
#include <stdexcept>
#include <utility>

namespace diptych::audit {

using experiment::knownOrInfinite;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void multiply(Image& image, double factor) {
    for (float& value : image.data) value = static_cast<float>(value * factor);
}

ChannelStats statsOf(Channel mode, const Frame& truth, const Frame& test, const Coverage& where) {
    const DebugMode& channel = debugMode(mode);
    return channelStats(channel.error_kind, channel.kind, truth.channels.at(mode), test.channels.at(mode),
                        where);
}

// 99th percentile over pixels of the largest component difference between images of lit, as a fraction of
// white. Both use the truth's exposure.
double imageError(const Frame& truth, const Frame& test, const Coverage& where, double exposure) {
    ImageScale scale;
    scale.exposure = exposureFor({}, &truth.channels.at(Channel::lit), where);
    scale.exposure.factor *= exposure;
    const Image8 a = channelImage(debugMode(Channel::lit), truth, scale),
                 b = channelImage(debugMode(Channel::lit), test, scale);
    std::vector<double> differences;
    const auto components = a.data.size() / where.covered.size();
    for (std::size_t i = 0; i < where.covered.size(); ++i) {
        if (!where.covered[i]) continue;
        int max = 0;
        for (std::size_t c = i * components; c < (i + 1) * components; ++c)
            max = std::max(max, std::abs(int{a.data[c]} - int{b.data[c]}));
        differences.push_back(max);
    }
    return experiment::nearestRank(std::move(differences), 0.99) / 255.0;
}

// There the reference of captured surfaces traces its own rays through blended surfaces, whose light it
// filters differently from a path.
constexpr int blendedRadius = 2;

// Removes the pixels that `out` selects.
template <class Out>
void remove(Coverage& where, const Out& out) {
    for (std::size_t i = 0; i < where.covered.size(); ++i)
        if (where.covered[i] && out(i)) {
            where.covered[i] = 0;
            --where.count;
        }
}

// Keeps only the properties of a material that decide where its surface is visible.
void leaveShape(Material& material) {
    const TextureSlot color = material.base_color_texture;
    for (const MaterialSlot& slot : materialSlots) material.*slot.texture = {};
    if (material.alpha_mode != AlphaMode::opaque) material.base_color_texture = color;
}

RenderOptions drawing(std::vector<Channel> channels) {
    RenderOptions options;
    options.channels = std::move(channels);
    options.requested = options.channels;
    options.recheck = false;
    options.runs = 0;
    return options;
}

Outcome failedOutcome(const std::string& why) {
    Outcome outcome;
    for (const Measure error : {Measure::light_p99, Measure::light_p999, Measure::depth_p99, Measure::flip})
        outcome.measured[error] = infinity;
    outcome.measured[Measure::material_mismatch_pixels] = outcome.measured[Measure::nonfinite_pixels] = 0;
    outcome.failed = why;
    return outcome;
}

}  // namespace

bool isNearBlended(const Image& blended, std::size_t pixel, int radius) {
    if (blended.pixels() == 0) return false;
    bool found = false;
    within(blended, pixel, radius, [&](std::size_t i, int, int) { found = found || *blended.pixel(i) > 0; });
    return found;
}

Settings Series::applied(Settings settings) const {
    settings.path = path;
    return experiment::changed(std::move(settings), changes);
}

std::string Series::describe() const {
    std::string text(nameOf(path));
    for (const Change& change : changes) text += fmt::format(", {} {}", change.option, change.value);
    return text;
}

ChosenSeries chosenOf(const std::vector<Series>& wanted,
                      const std::function<Settings(const Series&)>& settingsOf) {
    ChosenSeries chosen;
    std::vector<Settings> known;
    for (const Series& one : wanted) {
        const Settings settings = settingsOf(one);
        if (const auto problem = settings.problem()) {
            chosen.omitted.push_back(one.describe() + ": " + *problem);
            continue;
        }
        Settings effective = effectiveSettings(settings);
        const auto same = std::ranges::find(known, effective);
        if (same != known.end()) {
            const Series& as = chosen.series[static_cast<std::size_t>(same - known.begin())];
            chosen.omitted.push_back(fmt::format("{} draws the same as {}", one.describe(), as.describe()));
            continue;
        }
        known.push_back(std::move(effective));
        chosen.series.push_back(one);
    }
    return chosen;
}

ChosenSeries seriesOf(const Quantity& quantity, const Subject& subject) {
    Case original = subject.original;
    quantity.apply(original, subject, quantity.original(subject));
    std::vector<std::vector<Change>> changes{{}, {{"gbuffer", "full"}}};
    for (const Change& change : quantity.variants) changes.push_back({change});
    std::vector<Series> wanted;
    for (const std::vector<Change>& change : changes)
        for (const Path path : drawn_paths) wanted.push_back({path, change});
    return chosenOf(wanted, [&](const Series& series) { return series.applied(original.settings); });
}

Measurer::Measurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep)
    : device_(device), subject_(subject), on_step_(std::move(onStep)), pipelines_(makePipelineSet(device)) {}

Frame Measurer::litOfSurfaces(Renderer& renderer, Settings settings) {
    settings.reference_mode = ReferenceMode::surface;
    return renderer.draw(referenceSettings(settings), drawing({Channel::lit, Channel::material_id}));
}

Frame Measurer::tracedRays(Scene scene, Settings settings) {
    settings.reference_mode = ReferenceMode::scene;
    settings.shadows = Shadows::off;
    settings.haze = false;
    settings.env = Settings().env;
    settings.env_sun = false;
    scene.lights.clear();
    scene.environment.reset();
    for (Material& material : scene.materials) leaveShape(material);
    SceneViews views(scene);
    return std::move(drawWithoutDevice(views, {referenceSettings(settings)},
                                       drawing({Channel::material_id, Channel::depth}))
                         .front());
}

const Measurer::GroundTruth& Measurer::original(const Size& size) {
    const auto known = original_.find({size.width, size.height});
    if (known != original_.end()) return known->second;
    Settings settings = subject_.original.settings;
    settings.size = size;
    SceneViews views(subject_.original.scene);
    Renderer renderer(device_, views, pipelines_);
    GroundTruth truth{litOfSurfaces(renderer, settings), tracedRays(subject_.original.scene, settings)};
    return original_.emplace(std::pair(size.width, size.height), std::move(truth)).first->second;
}

Outcome Measurer::outcomeOf(const GroundTruth& truth, const Frame& lit, const Frame& rays, double exposure) {
    Outcome outcome;
    Coverage opaque = coverage(truth.lit, truth.lit);
    remove(opaque, [&](std::size_t i) { return isNearBlended(truth.lit.blended, i, blendedRadius); });
    const ChannelStats light = statsOf(Channel::lit, truth.lit, lit, opaque);
    outcome.measured[Measure::light_p99] = knownOrInfinite(light.p99);
    outcome.measured[Measure::light_p999] = knownOrInfinite(light.p999);
    outcome.worst_x = light.worst_x;
    outcome.worst_y = light.worst_y;
    if (exposure > 0) outcome.measured[Measure::light_p99] = imageError(truth.lit, lit, opaque, exposure);
    const Image &there = truth.rays.channels.at(Channel::material_id),
                &here = rays.channels.at(Channel::material_id);
    Coverage alike = coverage(truth.rays, truth.rays);
    const std::size_t before = alike.count;
    remove(alike, [&](std::size_t i) { return there.data[i] != here.data[i]; });
    outcome.measured[Measure::material_mismatch_pixels] = static_cast<double>(before - alike.count);
    outcome.measured[Measure::depth_p99] =
        knownOrInfinite(statsOf(Channel::depth, truth.rays, rays, alike).p99);
    outcome.measured[Measure::flip] =
        knownOrInfinite(hdrFlip(truth.lit.channels.at(Channel::lit), lit.channels.at(Channel::lit)).mean);
    outcome.measured.set(lit.counters);
    if (const auto repaired = lit.repaired.find(Channel::lit); repaired != lit.repaired.end()) {
        const auto width = static_cast<std::uint32_t>(lit.settings.size.width);
        outcome.worst_x = static_cast<int>(repaired->second.front() % width);
        outcome.worst_y = static_cast<int>(repaired->second.front() / width);
    }
    return outcome;
}

std::string Measurer::fingerprint() {
    const GroundTruth& truth = original(subject_.original.settings.size);
    return experiment::fingerprint(std::array{&truth.lit, &truth.rays});
}

Step Measurer::measure(const Quantity& quantity, std::span<const Series> series, double magnitude) {
    Case changed = subject_.original;
    quantity.apply(changed, subject_, magnitude);
    if (on_step_) on_step_(fmt::format("{} {:.4g} {}", quantity.name, magnitude, quantity.unit));
    return measure(changed, series, &quantity, magnitude);
}

Measurer::Drawn Measurer::draw(const Case& changed, std::span<const Series> series) {
    Drawn drawn;
    // One core traces rays while the device renders, and then shades the captured surfaces.
    std::future<Frame> rays =
        std::async(std::launch::async, [&changed] { return tracedRays(changed.scene, changed.settings); });
    {
        SceneViews views(changed.scene);
        Renderer renderer(device_, views, pipelines_);
        drawn.truth.lit = litOfSurfaces(renderer, changed.settings);
        Case faulty;
        std::optional<SceneViews> faulty_views;
        std::optional<Renderer> faulty_renderer;
        if (fault_.scene) {
            faulty = changed;
            fault_.scene(faulty);
            faulty_views.emplace(faulty.scene);
            faulty_renderer.emplace(device_, *faulty_views, pipelines_);
        }
        std::vector<Channel> channels{Channel::lit, Channel::material_id, Channel::depth};
        channels.insert(channels.end(), fault_.channels.begin(), fault_.channels.end());
        for (const Series& one : series) {
            Frame& frame = drawn.frames.emplace_back();
            std::string& failed = drawn.failed.emplace_back();
            try {
                Renderer& drawer = faulty_renderer ? *faulty_renderer : renderer;
                frame = drawer.draw(withoutReference(one.applied(changed.settings)), drawing(channels));
                if (fault_.image) fault_.image(changed, frame);
            } catch (const std::exception& error) {
                failed = error.what();
            }
        }
    }
    drawn.truth.rays = rays.get();
    return drawn;
}

Step Measurer::measure(const Case& changed, std::span<const Series> series, const Quantity* quantity,
                       double magnitude) {
    Step step{magnitude, std::vector<Outcome>(series.size())};
    try {
        // A quantity that only changes images is rendered once.
        const bool cached = quantity && quantity->of_images && !fault_.scene && !fault_.image;
        Drawn own;
        Drawn& drawn = cached ? images_ : own;
        if (drawn.frames.empty() || drawn.frames.size() != series.size()) drawn = draw(changed, series);
        std::optional<GroundTruth> same;
        std::optional<double> moved;
        if (quantity && quantity->same_image) {
            same = original(changed.settings.size);
            if (quantity->light) multiply(same->lit.channels.at(Channel::lit), magnitude);
            if (quantity->lengths) multiply(same->rays.channels.at(Channel::depth), magnitude);
            moved = outcomeOf(*same, drawn.truth.lit, drawn.truth.rays).error();
        }
        const GroundTruth& truth = same ? *same : drawn.truth;
        for (std::size_t i = 0; i < series.size(); ++i) {
            Outcome& outcome = step.outcomes[i];
            outcome = drawn.failed[i].empty()
                          ? outcomeOf(truth, drawn.frames[i], drawn.frames[i], changed.exposure)
                          : failedOutcome(drawn.failed[i]);
            if (moved) outcome.measured[Measure::reference_moved] = *moved;
            outcome.measured[Measure::compared_pixels] =
                static_cast<double>(coverage(truth.rays, truth.rays).count);
        }
    } catch (const std::exception& error) {
        step.outcomes.assign(series.size(), failedOutcome(error.what()));
    }
    for (std::size_t i = 0; i < series.size(); ++i) {
        Outcome& outcome = step.outcomes[i];
        outcome.settings = series[i].applied(changed.settings);
        if (quantity) outcome.varied = quantity->name;
        outcome.measured[Measure::magnitude] = magnitude;
    }
    return step;
}

}  // namespace diptych::audit
