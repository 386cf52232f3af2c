// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/explanations.h"
#include "compare/cli/verdict_words.h"
#include "compare/external/external_frame.h"
#include "compare/files/frame_exr.h"
#include "compare/files/output.h"
#include "compare/render/frame_facts.h"
#include "compare/render/reference_frame.h"
#include "compare/report/exposure_line.h"
#include "compare/report/report.h"
#include "compare/run/command_text.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/load.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace diptych::cli {
namespace {

// What both paths drew, of every scene and camera.
struct Drawn {
    std::vector<Frame> frames;  // two by two; three by three where the reference comes first
    std::vector<Requirements> needs;
    // Per scene and camera: what a person must look at, and the materials' names by id.
    std::vector<std::vector<FeatureChecks>> visual_checks;
    std::vector<std::vector<std::string>> materials;
    std::optional<TextureSampling> texels;  // with a reference in mode scene
    std::vector<ExternalPicture> external;  // of --renderer
    std::vector<SceneError> errors;
};

bool againstReference(const Options& options) {
    return options.baseline == Path::reference && options.baseline_file.empty();
}

std::vector<Path> pathsOf(const Options& options) {
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (againstReference(options)) paths.insert(paths.begin(), Path::reference);
    return paths;
}

std::vector<std::string> materialNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    return names;
}

// Whether a comparison is with a reference in mode scene, drawn now or read from a file.
bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline) {
    const auto traced = [](const Settings& s) {
        return s.path == Path::reference && s.reference_mode == ReferenceMode::scene;
    };
    return std::ranges::any_of(settings, traced) ||
           (baseline && isReferenceFrame(*baseline) && traced(baseline->settings));
}

// Where in the command's time drawing ends, and comparing. In frames drawn, to a Frame: comparing takes one,
// writing the report three (lavapipe, the gallery at 1280x720: 4.8 s, 0.3 s and 0.9 s).
struct Shares {
    double drawn, compared;
};
Shares sharesOf(const RenderOptions& render) {
    const double frames = framesIn(render);
    return {frames / (frames + 4), (frames + 1) / (frames + 4)};
}

// What a reference in mode scene grants the device, if some scene has textures.
std::optional<TextureSampling> texelsFor(const Options& options, const std::vector<Settings>& settings,
                                         Device& device, bool textures) {
    const bool scenes = std::ranges::any_of(settings, [](const Settings& s) {
        return s.path == Path::reference && s.reference_mode == ReferenceMode::scene;
    });
    if (!textures || !againstReference(options) || !scenes) return {};
    return probeTextures(device, settings.front().textures);  // of all alike
}

// The left panel's place among a report's Frames, of those of one view that begin at `first`.
std::size_t leftPanel(const Options& options, std::size_t first) {
    if (!options.baseline_file.empty()) return 0;
    if (againstReference(options)) return first;
    const auto path = std::ranges::find(drawn_paths, options.baseline);
    return first + static_cast<std::size_t>(path - drawn_paths.begin());
}

// One view by every renderer that is not ours. One that fails is an error of the report, and nothing is
// compared with it.
void drawExternals(const Scene& scene, const SceneView& view, const Settings& settings,
                   const Options& options, std::size_t baseline, const Stage& stage,
                   std::vector<ExternalPicture>& pictures, std::vector<SceneError>& errors) {
    const auto all = static_cast<double>(options.renderers.size());
    for (std::size_t i = 0; i < options.renderers.size(); ++i) {
        const external::Renderer& renderer = options.renderers[i];
        say(options, fmt::format("{}: {}", renderer.name,
                                 oneLine(fmt::format("{}", fmt::join(renderer.command, " ")))));
        stage.at(static_cast<double>(i) / all, renderer.name);
        external::Attempt attempt = external::drawExternally(renderer, scene, view, settings);
        if (attempt.frame) {
            pictures.push_back({std::move(*attempt.frame), view.needs, baseline, options.renderer_words});
        } else {
            errors.push_back({scene.name,
                              fmt::format("{}: renderer {} ({}): {}", scene.name, renderer.name,
                                          renderer.file.string(), attempt.problem),
                              renderer.name, std::move(attempt.said)});
        }
    }
}

// One scene by all paths and cameras. Adds to `drawn` when all is done.
void drawScene(const Scene& scene, const Options& options, const std::vector<Settings>& settings,
               Device& device, const RenderOptions& render, const Stage& outside, Drawn& drawn) {
    SceneViews views(scene);
    std::vector<Requirements> needs;
    for (const Settings& of : settings) needs.push_back(views.at(viewRequest(of)).needs);
    std::vector<Frame> frames = renderAll(device, views, settings, render);
    const std::size_t together = pathsOf(options).size();
    std::vector<ExternalPicture> external;
    for (std::size_t k = 0; k < frames.size(); k += together) {
        const Frame& shown = frames[k + together - 2];
        drawn.visual_checks.push_back(visualChecksOf(scene, views.at(viewRequest(shown.settings)), shown));
        drawn.materials.push_back(materialNames(scene));
        drawExternals(scene, views.at(viewRequest(shown.settings)), shown.settings, options,
                      leftPanel(options, drawn.frames.size() + k), outside, external, drawn.errors);
        letGo(shown);
    }
    std::ranges::move(external, std::back_inserter(drawn.external));
    std::ranges::move(needs, std::back_inserter(drawn.needs));
    std::ranges::move(frames, std::back_inserter(drawn.frames));
}

// Runs what is about one scene. Of several, one that cannot be read or drawn becomes an error of the report,
// and the others are compared; the error of the only one is everything that there is to say.
template <class Run>
bool succeeds(const Options& options, const std::string& name, std::vector<SceneError>& errors,
              const Run& run) {
    if (options.scenes.size() == 1) {
        run();
        return true;
    }
    try {
        run();
        return true;
    } catch (const std::system_error&) {
        throw;  // of this machine
    } catch (const std::runtime_error& error) {
        errors.push_back({name, error.what()});
        say(options, fmt::format("{}; the other scenes are compared", error.what()));
        return false;
    }
}

// Before anything is drawn, which may take long.
std::vector<std::string> soundScenes(const Options& options, std::vector<SceneError>& errors) {
    std::vector<std::string> sound;
    for (const std::string& name : options.scenes)
        if (options.scenes.size() == 1 || succeeds(options, name, errors, [&] { checkScene(name); }))
            sound.push_back(name);
    return sound;
}

Drawn draw(const Options& options, const std::vector<Settings>& settings, RenderOptions render,
           Device& device, KeptReferences& kept, Progress& progress) {
    render.keep = [&kept](std::uint64_t key, std::size_t floats) -> reference::Checkpoint& {
        return kept.open(key, floats);
    };
    const double drawing = sharesOf(render).drawn;
    Drawn drawn;
    const std::vector<std::string> names = soundScenes(options, drawn.errors);
    bool textures = false;
    const auto scenes = static_cast<double>(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& name = names[i];
        say(options, name);
        const auto done = static_cast<double>(i);
        const Stage stage =
            Stage(progress, name).part(drawing * done / scenes, drawing * (done + 1) / scenes);
        const double loading = loadingShare(name, render, settings.size());
        succeeds(options, name, drawn.errors, [&] {
            const Scene scene = loadShown(name, options.settings, stage.part(0, loading));
            const double ours = options.renderers.empty() ? 1 : 0.5 * (loading + 1);
            render.progress = stage.part(loading, ours);
            drawScene(scene, options, settings, device, render, stage.part(ours, 1), drawn);
            textures = textures || !scene.textures.empty();
        });
    }
    if (drawn.frames.empty())
        throw std::runtime_error(fmt::format("none of the {} scenes can be drawn; the first: {}",
                                             options.scenes.size(), drawn.errors.front().message));
    drawn.texels = texelsFor(options, settings, device, textures);
    checkValidation(device);
    return drawn;
}

// The one scene, camera and time that a picture can be of.
void checkOnePicture(const Options& options, const std::vector<Settings>& settings) {
    if (options.scenes.size() != 1 || settings.size() != 2)
        throw std::runtime_error(fmt::format("--baseline {}: is one picture, so give one scene, one camera{}",
                                             options.baseline_file.string(),
                                             options.times.size() > 1 ? " and one time" : ""));
}

// The reference must have samples where the paths have them; and what is compared with it then is lit.
void checkSamples(const Options& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline) {
    std::optional<Settings> reference;
    if (againstReference(options)) reference = referenceSettings(options.settings);
    if (baseline && isReferenceFrame(*baseline)) reference = baseline->settings;
    if (!reference) return;
    for (const Settings& s : settings) {
        if (s.path == Path::reference || s.msaa == 1) continue;
        if (const std::string problem = samplesProblem(*reference, s); !problem.empty())
            throw std::runtime_error(problem);
        if (!options.channels.empty() &&
            std::ranges::count(options.channels, static_cast<int>(gpu::DEBUG_lit)) == 0)
            throw std::runtime_error(fmt::format(
                "--msaa {}: lit alone is compared with the reference; add it to --channels", s.msaa));
    }
}

// Which of the Frames drawn becomes the baseline: as the file says, or --path.
const Frame& renewing(const Options& options, const Frame* old, const std::vector<Frame>& frames) {
    const Path path = old && !options.path_given && old->settings.path != Path::reference
                          ? old->settings.path
                          : options.settings.path;
    for (const Frame& frame : frames)
        if (frame.settings.path == path) return frame;
    throw std::runtime_error(fmt::format("--path {}: compare draws deferred and forward_plus", nameOf(path)));
}

Report reportOf(const Options& options, CompareOptions compare, Drawn& drawn, std::optional<Frame> baseline,
                const ReportDevice& device, const Stage& progress) {
    compare.progress = progress;
    compare.texels = drawn.texels;
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

int runCompare(const Options& options) {
    if (options.pixel) return runPixel(options);
    const std::vector<Settings> settings = settingsOf(options, pathsOf(options));
    const std::filesystem::path folder = outputFolder(options, "diptych-report", "report", "report.json");
    if (options.path_given && !options.update_baseline)
        note(options, "--path is not used: compare draws both");
    if (options.heat) note(options, "--heat is not used: the report shows every channel, light_count too");
    if (options.debug_given) note(options, "--debug is not used: the report shows every channel");
    const PictureChoice picture = pictureChoice(options);
    const CompareOptions compare = compareOptions(options);
    std::optional<Frame> baseline;
    if (!options.baseline_file.empty()) {
        checkOnePicture(options, settings);
        if (!options.update_baseline || std::filesystem::exists(options.baseline_file))
            baseline = frameFromExr(options.baseline_file);
    }
    checkSamples(options, settings, baseline);

    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    KeptReferences kept(folder, true);
    const RenderOptions render =
        judgedOptions(renderOptions(options), options.settings, isTraced(settings, baseline));
    Drawn drawn = draw(options, settings, render, device, kept, progress);
    const ReportDevice here = reportDevice(device);
    std::string updated;
    if (options.update_baseline)
        updated = updateBaseline(options.baseline_file,
                                 renewing(options, baseline ? &*baseline : nullptr, drawn.frames), here);
    const Stage stage(progress, folder.string());
    const auto [drawing, comparing] = sharesOf(render);
    Report report =
        reportOf(options, compare, drawn, std::move(baseline), here, stage.part(drawing, comparing));
    addExternalPictures(report, std::move(drawn.external), compare);
    report.errors = std::move(drawn.errors);
    for (Comparison& comparison : report.comparisons)
        comparison.command = withOption(comparison.command, "-o", againFolder(folder));
    double explained = comparing;
    if (isExplained(options, report)) {
        explained = 0.5 * (1 + comparing);
        addExplanations(options, device, report, stage.part(comparing, explained));
    }
    const std::string json =
        writeReport(report, folder,
                    {picture, options.single_file, options.keep, options.force, stage.part(explained, 1)});
    kept.remove();
    progress.wipe();
    noteLeftByOthers(options, kept);
    if (options.json)
        fmt::print("{}", json);
    else if (!options.quiet)
        printColored(options, fmt::format("{}pictures: {}\nreport: {}\n", reportTable(report),
                                          exposureLine(report, picture), (folder / "index.html").string()));
    if (!updated.empty()) note(options, updated);
    sayErrors(report.errors);
    if (!report.errors.empty()) return 2;
    // The old baseline's verdict is no longer the question.
    return (options.update_baseline ? report.comparisons.back().passed() : report.passed()) ? 0 : 1;
}

}  // namespace diptych::cli
