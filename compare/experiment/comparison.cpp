// SPDX-License-Identifier: MIT
#include "compare/experiment/comparison.h"

#include "compare/experiment/two_devices.h"
#include "compare/external/external_frame.h"
#include "compare/render/frame_facts.h"
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
                                         Device& device, bool textures, TextureProbe& probe) {
    const bool scenes = std::ranges::any_of(settings, [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    });
    if (!textures || !compared.withReference() || !scenes) return {};
    if (!probe) probe = probeTextures(device, settings.front().textures);  // the same for all Settings
    return probe;
}

// Index of the left panel's Frame in the report. The view's Frames begin at `first`.
std::size_t leftPanel(const Compared& compared, std::size_t first) {
    if (compared.from_file) return 0;
    if (compared.withReference()) return first;
    const auto path = std::ranges::find(drawn_paths, compared.baseline);
    return first + static_cast<std::size_t>(path - drawn_paths.begin());
}

// Short device name for Frames and files: "SwiftShader" for "SwiftShader Device (Subzero)".
std::string shortName(const std::string& device) {
    const auto end =
        std::ranges::find_if(device, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return std::string(device.begin(), end);
}

// Inserts the other device's Frames after those of each view, and adds the inputs of their verdicts.
void addOtherDevice(const Scene& scene, SceneViews& views, Device& device, AgainstDevice& against,
                    std::vector<Frame> there, const std::shared_ptr<PipelineSet>& pipelines,
                    DrawnScene& drawn) {
    Renderer renderer(device, views, pipelines);
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

// Renders the view of `shown` with every external renderer. A failed renderer becomes an error of the report.
void drawExternals(SceneViews& views, const Frame& shown, const Compared& compared, std::size_t baseline,
                   const std::function<void(const std::string&)>& on_step, const Stage& stage,
                   DrawnScene& drawn) {
    const Scene& scene = views.scene();
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
                {std::move(*attempt.frame), view.needs, baseline, compared.renderer_words});
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

Shares sharesOf(const RenderOptions& render) {
    const double frames = framesIn(render);
    return {frames / (frames + 4), (frames + 1) / (frames + 4)};
}

DrawnScene drawScene(const Scene& scene, const Compared& compared, const std::vector<Settings>& settings,
                     Device& device, const RenderOptions& render, TextureProbe& probe, const Stage& outside,
                     const std::shared_ptr<PipelineSet>& pipelines, AgainstDevice* against) {
    DrawnScene drawn;
    SceneViews views(scene);
    for (const Settings& of : settings) drawn.needs.push_back(views.at(viewRequest(of)).needs);
    RenderOptions first = render, second = render;
    if (against) {
        first.progress = render.progress.part(0, 0.5);
        second.progress = render.progress.part(0.5, 1);
    }
    drawn.frames = renderAll(device, views, settings, first, pipelines);
    const std::size_t together = compared.paths().size();
    for (std::size_t k = 0; k < drawn.frames.size(); k += together) {
        const Frame& shown = drawn.frames[k + together - 2];
        drawn.visual_checks.push_back(visualChecksOf(scene, views.at(viewRequest(shown.settings)), shown));
        drawn.materials.push_back(materialNames(scene));
        drawExternals(views, shown, compared, leftPanel(compared, k), render.on_step, outside, drawn);
        letGo(shown);
    }
    if (against)
        addOtherDevice(scene, views, device, *against,
                       renderAll(against->device, views, settings, second, against->pipelines), pipelines,
                       drawn);
    drawn.texels = texelsFor(compared, settings, device, !scene.textures.empty(), probe);
    return drawn;
}

namespace {

Report comparisonsOf(const Compared& compared, const CompareOptions& compare, DrawnScene drawn,
                     std::optional<Frame> baseline, const ReportDevice& device, const ReportDevice& against) {
    if (!drawn.across.empty())
        return makeDeviceReport(std::move(drawn.frames), drawn.needs, device, against, compare,
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
                std::optional<Frame> baseline, const ReportDevice& device, const ReportDevice& against,
                const std::string& again, const Stage& progress) {
    compare.progress = progress;
    compare.rules = rulesOfScene(compare.rules, drawn.frames.front().scene);
    compare.texels = drawn.texels;
    std::vector<ExternalPicture> external = std::move(drawn.external);
    std::vector<SceneError> errors = std::move(drawn.errors);
    Report report = comparisonsOf(compared, compare, std::move(drawn), std::move(baseline), device, against);
    addExternalPictures(report, std::move(external), compare);
    report.errors = std::move(errors);
    for (Comparison& comparison : report.comparisons)
        comparison.command = withOption(comparison.command, "-o", again);
    return report;
}

}  // namespace diptych::experiment
