// SPDX-License-Identifier: MIT
#include "compare/experiment/comparison.h"

#include "compare/experiment/two_devices.h"
#include "compare/external/external_frame.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/renderer.h"
#include "compare/run/command_text.h"
#include "compare/verdict/baseline.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

namespace diptych::experiment {
namespace {

std::vector<std::string> materialNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    return names;
}

// Measured texture sampling of the device, a tolerance for comparisons with a traced reference. Empty if
// not needed.
std::optional<TextureSampling> texelsFor(const Compared& compared, const std::vector<Settings>& settings,
                                         Devices& devices, bool textures) {
    const bool scenes = std::ranges::any_of(settings, [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    });
    if (!textures || !compared.withReference() || !scenes) return {};
    if (!devices.texels)  // the same for all Settings
        devices.texels = probeTextures(devices.device, settings.front().textures);
    return devices.texels;
}

// Short device name for Frames and files: "SwiftShader" for "SwiftShader Device (Subzero)".
std::string shortName(const std::string& device) {
    const auto end =
        std::ranges::find_if(device, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return std::string(device.begin(), end);
}

// Adds the other device's Frames to those of each view, and the inputs of their verdicts.
void addOtherDevice(SceneViews& views, Devices& devices, std::vector<Frame> there, DrawnScene& drawn) {
    const Scene& scene = views.scene();
    Device& device = devices.device;
    Devices::Against& against = *devices.against;
    Renderer renderer(device, views, devices.pipelines);
    if (!scene.textures.empty() && !against.precision[0].texels)
        against.precision = precisionsOf(device, against.device, true, there.front().settings.textures);
    const auto note = [](Frame& frame, const Device& on) {
        frame.origin.device = on.info().name;
        frame.origin.driver = on.info().driver;
    };
    auto next = there.begin();
    for (ViewFrames& view : drawn.views) {
        const Frame& forward = *view.by(unencoded_path);
        AcrossDevices across =
            acrossDevices(scene, views.at(viewRequest(forward.settings)), against.precision, forward);
        for (Frame& frame : view.frames) {
            Frame& other = view.there.emplace_back(std::move(*next++));
            note(frame, device);
            note(other, against.device);
            other.name += "-on-" + shortName(against.device.info().name);
            across.relit = relit(device, renderer, other);
            view.across.emplace(frame.settings.path, across);
        }
    }
}

// Renders a view with every external renderer. A failed renderer becomes an error of the report.
void drawExternals(SceneViews& views, const Compared& compared, ViewFrames& of,
                   const std::function<void(const std::string&)>& on_step, const Stage& stage,
                   std::vector<SceneError>& errors) {
    const Scene& scene = views.scene();
    const Frame& shown = *of.by(drawn_paths[0]);
    const SceneView& view = views.at(viewRequest(shown.settings));
    const auto all = static_cast<double>(compared.renderers.size());
    for (std::size_t i = 0; i < compared.renderers.size(); ++i) {
        const external::ExternalRenderer& renderer = compared.renderers[i];
        if (on_step)
            on_step(fmt::format("{}: {}", renderer.name,
                                oneLine(fmt::format("{}", fmt::join(renderer.command, " ")))));
        stage.at(static_cast<double>(i) / all, renderer.name);
        external::Attempt attempt = external::drawExternally(renderer, scene, view, shown.settings);
        if (attempt.frame)
            of.external.push_back(std::move(*attempt.frame));
        else
            errors.push_back({scene.name,
                              fmt::format("{}: renderer {} ({}): {}", scene.name, renderer.name,
                                          renderer.file.string(), attempt.problem),
                              renderer.name, std::move(attempt.output)});
    }
}

}  // namespace

std::vector<Path> Compared::paths() const {
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (withReference()) paths.insert(paths.begin(), Path::reference);
    return paths;
}

Devices::Devices(Device& of, Device* other, bool sharePipelines)
    : device(of),
      pipelines(sharePipelines ? makePipelineSet(of) : nullptr),
      against(other ? std::optional(Against{*other, sharePipelines ? makePipelineSet(*other) : nullptr,
                                            precisionsOf(of, *other)})
                    : std::nullopt) {}

std::vector<const Device*> Devices::all() const {
    std::vector<const Device*> all{&device};
    if (against) all.push_back(&against->device);
    return all;
}

Fractions fractionsOf(const RenderOptions& render) {
    const double frames = framesIn(render);
    return {frames / (frames + 4), (frames + 1) / (frames + 4)};
}

DrawnScene drawScene(const Scene& scene, const Compared& compared, const std::vector<Settings>& settings,
                     Devices& devices, const RenderOptions& render, const Stage& outside) {
    DrawnScene drawn;
    SceneViews views(scene);
    RenderOptions first = render, second = render;
    if (devices.against) {
        first.progress = render.progress.part(0, 0.5);
        second.progress = render.progress.part(0.5, 1);
    }
    // A path's second Frame begins the next view.
    for (Frame& frame : renderAll(devices.device, views, settings, first, devices.pipelines)) {
        if (drawn.views.empty() || drawn.views.back().by(frame.settings.path))
            drawn.views.push_back({{}, views.at(viewRequest(frame.settings)).needs});
        drawn.views.back().frames.push_back(std::move(frame));
    }
    for (ViewFrames& view : drawn.views) {
        const Frame& shown = *view.by(drawn_paths[0]);
        view.checks = visualChecksOf(scene, views.at(viewRequest(shown.settings)), shown);
        view.materials = materialNames(scene);
        drawExternals(views, compared, view, render.on_step, outside, drawn.errors);
        letGo(shown);
    }
    if (const auto& other = devices.against)
        addOtherDevice(views, devices, renderAll(other->device, views, settings, second, other->pipelines),
                       drawn);
    drawn.texels = texelsFor(compared, settings, devices, !scene.textures.empty());
    return drawn;
}

Report reportOf(const Compared& compared, CompareOptions compare, DrawnScene drawn,
                std::optional<Frame> baseline, const Devices& devices, const std::string& again) {
    const Frame& first = drawn.views.front().frames.front();
    const ReportDevice device = reportDevice(devices.device);
    compare.rules = rulesOfScene(compare.rules, first.scene);
    compare.texels = drawn.texels;
    compare.renderer_texts = compared.renderer_texts;
    std::vector<std::string> mismatches;
    if (baseline) {
        mismatches = baselineMismatches(*baseline, first, device);
        baseline->requested = first.requested;
    }
    Report report = makeReport(std::move(drawn.views), device, compare, std::move(baseline),
                               devices.against ? reportDevice(devices.against->device) : ReportDevice());
    report.first_notes = std::move(mismatches);
    report.errors = std::move(drawn.errors);
    for (Comparison& comparison : report.comparisons)
        comparison.command = withOption(comparison.command, "-o", again);
    return report;
}

}  // namespace diptych::experiment
