// SPDX-License-Identifier: MIT
#include "compare/experiment/comparison.h"

#include "compare/experiment/two_devices.h"
#include "compare/external/external_frame.h"
#include "compare/frames/frame_facts.h"
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

// Index of the left panel's Frame in the report. The view's Frames begin at `first`.
std::size_t leftPanel(const Compared& compared, std::size_t first) {
    if (compared.from_file) return 0;
    if (compared.withReference()) return first;
    const auto path = std::ranges::find(drawn_paths, compared.baseline);
    return first + static_cast<std::size_t>(path - drawn_paths.begin());
}

// Index of the Frame by the view's first path.
std::size_t shownOf(const Compared& compared, std::size_t first) {
    return first + compared.paths().size() - drawn_paths.size();
}

// Short device name for Frames and files: "SwiftShader" for "SwiftShader Device (Subzero)".
std::string shortName(const std::string& device) {
    const auto end =
        std::ranges::find_if(device, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return std::string(device.begin(), end);
}

// Inserts the other device's Frames after those of each view, and adds the inputs of their verdicts.
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
    std::vector<Frame> frames;
    for (std::size_t i = 0; i + 1 < there.size(); i += 2) {
        const std::size_t forward = shadesFragments(drawn.frames[i].settings.path) ? i : i + 1;
        AcrossDevices across = acrossDevices(scene, views.at(viewRequest(drawn.frames[forward].settings)),
                                             against.precision, drawn.frames[forward]);
        for (const std::size_t k : {i, i + 1}) {
            Frame &a = drawn.frames[k], &b = there[k];
            note(a, device);
            note(b, against.device);
            b.name += "-on-" + shortName(against.device.info().name);
            across.relit = relit(device, renderer, b);
            drawn.across.push_back(across);
        }
        for (std::vector<Frame>* of : {&drawn.frames, &there})
            for (const std::size_t k : {i, i + 1}) frames.push_back(std::move((*of)[k]));
    }
    drawn.frames = std::move(frames);
}

// Renders a view, whose Frames begin at `first`, with every external renderer. A failed renderer becomes an
// error of the report.
void drawExternals(SceneViews& views, const Compared& compared, std::size_t first,
                   const std::function<void(const std::string&)>& on_step, const Stage& stage,
                   DrawnScene& drawn) {
    const Scene& scene = views.scene();
    const Frame& shown = drawn.frames[shownOf(compared, first)];
    const SceneView& view = views.at(viewRequest(shown.settings));
    const auto all = static_cast<double>(compared.renderers.size());
    for (std::size_t i = 0; i < compared.renderers.size(); ++i) {
        const external::Renderer& renderer = compared.renderers[i];
        if (on_step)
            on_step(fmt::format("{}: {}", renderer.name,
                                oneLine(fmt::format("{}", fmt::join(renderer.command, " ")))));
        stage.at(static_cast<double>(i) / all, renderer.name);
        external::Attempt attempt = external::drawExternally(renderer, scene, view, shown.settings);
        if (attempt.frame) {
            drawn.external.push_back(
                {std::move(*attempt.frame), view.needs, leftPanel(compared, first), compared.renderer_words});
        } else {
            drawn.errors.push_back({scene.name,
                                    fmt::format("{}: renderer {} ({}): {}", scene.name, renderer.name,
                                                renderer.file.string(), attempt.problem),
                                    renderer.name, std::move(attempt.output)});
        }
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

Shares sharesOf(const RenderOptions& render) {
    const double frames = framesIn(render);
    return {frames / (frames + 4), (frames + 1) / (frames + 4)};
}

DrawnScene drawScene(const Scene& scene, const Compared& compared, const std::vector<Settings>& settings,
                     Devices& devices, const RenderOptions& render, const Stage& outside) {
    DrawnScene drawn;
    SceneViews views(scene);
    for (const Settings& of : settings) drawn.needs.push_back(views.at(viewRequest(of)).needs);
    RenderOptions first = render, second = render;
    if (devices.against) {
        first.progress = render.progress.part(0, 0.5);
        second.progress = render.progress.part(0.5, 1);
    }
    drawn.frames = renderAll(devices.device, views, settings, first, devices.pipelines);
    for (std::size_t k = 0; k < drawn.frames.size(); k += compared.paths().size()) {
        const Frame& shown = drawn.frames[shownOf(compared, k)];
        drawn.visual_checks.push_back(visualChecksOf(scene, views.at(viewRequest(shown.settings)), shown));
        drawn.materials.push_back(materialNames(scene));
        drawExternals(views, compared, k, render.on_step, outside, drawn);
        letGo(shown);
    }
    if (const auto& other = devices.against)
        addOtherDevice(views, devices, renderAll(other->device, views, settings, second, other->pipelines),
                       drawn);
    drawn.texels = texelsFor(compared, settings, devices, !scene.textures.empty());
    return drawn;
}

namespace {

Report comparisonsOf(const Compared& compared, const CompareOptions& compare, DrawnScene drawn,
                     std::optional<Frame> baseline, const Devices& devices) {
    const ReportDevice device = reportDevice(devices.device);
    if (devices.against)
        return makeDeviceReport(std::move(drawn.frames), drawn.needs,
                                {device, reportDevice(devices.against->device)}, compare,
                                std::move(drawn.across), std::move(drawn.visual_checks));
    if (compared.withReference())
        return makeReferenceReport(std::move(drawn.frames), drawn.needs, device, compare,
                                   std::move(drawn.visual_checks), drawn.materials);
    if (!baseline)
        return makeReport(std::move(drawn.frames), drawn.needs, device, compare,
                          std::move(drawn.visual_checks));
    baseline->requested = drawn.frames.front().requested;
    return makeBaselineReport(std::move(*baseline), std::move(drawn.frames), drawn.needs.front(), device,
                              compare, baselineMismatches(*baseline, drawn.frames.front(), device));
}

}  // namespace

Report reportOf(const Compared& compared, CompareOptions compare, DrawnScene drawn,
                std::optional<Frame> baseline, const Devices& devices, const std::string& again) {
    compare.rules = rulesOfScene(compare.rules, drawn.frames.front().scene);
    compare.texels = drawn.texels;
    std::vector<ExternalPicture> external = std::move(drawn.external);
    std::vector<SceneError> errors = std::move(drawn.errors);
    Report report = comparisonsOf(compared, compare, std::move(drawn), std::move(baseline), devices);
    addExternalPictures(report, std::move(external), compare);
    report.errors = std::move(errors);
    for (Comparison& comparison : report.comparisons)
        comparison.command = withOption(comparison.command, "-o", again);
    return report;
}

}  // namespace diptych::experiment
