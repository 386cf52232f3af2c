// SPDX-License-Identifier: MIT
#include "compare/cli/scene_comparison.h"

#include "compare/cli/commands.h"
#include "compare/explain/two_devices.h"
#include "compare/external/external_frame.h"
#include "compare/render/frame_facts.h"
#include "compare/render/reference_frame.h"
#include "compare/render/renderer.h"
#include "compare/run/command_text.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace diptych::cli {
namespace {

std::vector<std::string> materialNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    return names;
}

// Measured texture sampling of the device, a tolerance for comparisons with a traced reference. Empty if
// not needed.
std::optional<TextureSampling> texelsFor(const Options& options, const std::vector<Settings>& settings,
                                         Device& device, bool textures, TextureProbe& probe) {
    const bool scenes = std::ranges::any_of(settings, [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    });
    if (!textures || !againstReference(options) || !scenes) return {};
    if (!probe) probe = probeTextures(device, settings.front().textures);  // the same for all Settings
    return probe;
}

// Index of the left panel's Frame in the report. The view's Frames begin at `first`.
std::size_t leftPanel(const Options& options, std::size_t first) {
    if (!options.baseline_file.empty()) return 0;
    if (againstReference(options)) return first;
    const auto path = std::ranges::find(drawn_paths, options.baseline);
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

// Renders one view with every external renderer. A failed renderer becomes an error of the report.
void drawExternals(const Scene& scene, const SceneView& view, const Settings& settings,
                   const Options& options, std::size_t baseline, const Stage& stage, DrawnScene& drawn) {
    const auto all = static_cast<double>(options.renderers.size());
    for (std::size_t i = 0; i < options.renderers.size(); ++i) {
        const external::Renderer& renderer = options.renderers[i];
        say(options, fmt::format("{}: {}", renderer.name,
                                 oneLine(fmt::format("{}", fmt::join(renderer.command, " ")))));
        stage.at(static_cast<double>(i) / all, renderer.name);
        external::Attempt attempt = external::drawExternally(renderer, scene, view, settings);
        if (attempt.frame) {
            drawn.external.push_back(
                {std::move(*attempt.frame), view.needs, baseline, options.renderer_words});
        } else {
            drawn.errors.push_back({scene.name,
                                    fmt::format("{}: renderer {} ({}): {}", scene.name, renderer.name,
                                                renderer.file.string(), attempt.problem),
                                    renderer.name, std::move(attempt.output)});
        }
    }
}

}  // namespace

bool againstReference(const Options& options) {
    return isReference(options.baseline) && options.baseline_file.empty();
}

std::vector<Path> comparedPaths(const Options& options) {
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (againstReference(options)) paths.insert(paths.begin(), Path::reference);
    return paths;
}

bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline) {
    const auto traced = [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    };
    return std::ranges::any_of(settings, traced) ||
           (baseline && isReferenceFrame(*baseline) && traced(baseline->settings));
}

void checkSamples(const Options& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline) {
    std::optional<Settings> reference;
    if (againstReference(options)) reference = referenceSettings(options.settings);
    if (baseline && isReferenceFrame(*baseline)) reference = baseline->settings;
    if (!reference) return;
    for (const Settings& s : settings) {
        if (isReference(s.path) || s.msaa == 1) continue;
        if (const std::string problem = samplesProblem(*reference, s); !problem.empty())
            throw std::runtime_error(problem);
        if (!options.channels.empty() &&
            std::ranges::count(options.channels, static_cast<int>(gpu::DEBUG_lit)) == 0)
            throw std::runtime_error(fmt::format(
                "--msaa {}: only lit is compared with the reference; add it to --channels", s.msaa));
    }
}

void checkAgainstDevice(const Options& options, const std::vector<Settings>& settings) {
    if (options.against_device.empty()) return;
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("--against-device {}: {}", options.against_device, why));
    };
    if (againstReference(options) || !options.baseline_file.empty())
        refuse(
            "compares each path with itself on another device; leave out --baseline reference or FILE.exr");
    if (options.pixel) refuse("compares whole images; leave out --pixel");
    if (!options.renderers.empty()) refuse("compares two devices; leave out --renderer");
    for (const Settings& of : settings)
        if (of.msaa > 1)
            refuse(
                fmt::format("--msaa {}: lit averages several samples, but the surface channels hold only the "
                            "first; use --msaa 1",
                            of.msaa));
}

Shares sharesOf(const RenderOptions& render) {
    const double frames = framesIn(render);
    return {frames / (frames + 4), (frames + 1) / (frames + 4)};
}

double ourShare(const Options& options) {
    return options.renderers.empty() ? 1 : 0.5;
}

DrawnScene drawScene(const Scene& scene, const Options& options, const std::vector<Settings>& settings,
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
    const std::size_t together = comparedPaths(options).size();
    for (std::size_t k = 0; k < drawn.frames.size(); k += together) {
        const Frame& shown = drawn.frames[k + together - 2];
        drawn.visual_checks.push_back(visualChecksOf(scene, views.at(viewRequest(shown.settings)), shown));
        drawn.materials.push_back(materialNames(scene));
        drawExternals(scene, views.at(viewRequest(shown.settings)), shown.settings, options,
                      leftPanel(options, k), outside, drawn);
        letGo(shown);
    }
    if (against)
        addOtherDevice(scene, views, device, *against,
                       renderAll(against->device, views, settings, second, against->pipelines), pipelines,
                       drawn);
    drawn.texels = texelsFor(options, settings, device, !scene.textures.empty(), probe);
    return drawn;
}

namespace {

Report comparisonsOf(const Options& options, const CompareOptions& compare, DrawnScene drawn,
                     std::optional<Frame> baseline, const ReportDevice& device, const ReportDevice& against) {
    if (!drawn.across.empty())
        return makeDeviceReport(std::move(drawn.frames), drawn.needs, device, against, compare,
                                std::move(drawn.across), std::move(drawn.visual_checks));
    if (againstReference(options))
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

Report reportOf(const Options& options, CompareOptions compare, DrawnScene drawn,
                std::optional<Frame> baseline, const ReportDevice& device, const ReportDevice& against,
                const std::string& again, const Stage& progress) {
    compare.progress = progress;
    compare.rules = rulesOfScene(compare.rules, drawn.frames.front().scene);
    compare.texels = drawn.texels;
    std::vector<ExternalPicture> external = std::move(drawn.external);
    std::vector<SceneError> errors = std::move(drawn.errors);
    Report report = comparisonsOf(options, compare, std::move(drawn), std::move(baseline), device, against);
    addExternalPictures(report, std::move(external), compare);
    report.errors = std::move(errors);
    for (Comparison& comparison : report.comparisons)
        comparison.command = withOption(comparison.command, "-o", again);
    return report;
}

}  // namespace diptych::cli
