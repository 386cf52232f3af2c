// SPDX-License-Identifier: MIT
#include "compare/cli/command_compare.h"
#include "compare/cli/exit_code.h"

#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/verdict_options.h"
#include "compare/files/frame_exr.h"
#include "compare/files/scene_folders.h"
#include "compare/report/exposure_line.h"
#include "compare/report/report.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace diptych::cli {
namespace {

void describeCompare(CLI::App& app, CompareLine& options) {
    options.frames_refused = "only render takes it; compare takes --times";
    addScene(app, options, many_scenes_help);
    addAgainst(app, options,
               "also render each path on this device, and compare it with the same path on --device");
    addSides(app, options);
    addCompared(app, options, "report folder (diptych-report)");
    addShard(app, options, "diptych-report");
    addSince(app, options);
    addEvaluated(app, options);
    addOutput(app, options);
    acceptUnread(app, {"--debug", "--heat"});
    app.get_option("--path")->description("path that --update-baseline writes (the file's own)");
}

Pixel pixelOf(const std::string& words) {
    Pixel pixel;
    const char *at = words.data(), *const end = at + words.size();
    const auto [comma, first] = std::from_chars(at, end, pixel.x);
    bool sound = first == std::errc() && comma != end && *comma == ',';
    if (sound) {
        const auto [last, second] = std::from_chars(comma + 1, end, pixel.y);
        sound = second == std::errc() && last == end && pixel.x >= 0 && pixel.y >= 0;
    }
    if (!sound) refuse("--pixel {}: takes X,Y in pixels from the top left, for example 320,180", words);
    return pixel;
}

// Checks a multisampled comparison with the reference: the sample counts must match, and --channels have lit,
// which alone is compared then.
void checkSamples(const CompareLine& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline) {
    std::optional<Settings> reference;
    if (comparedOf(options).withReference()) reference = referenceSettings(options.settings);
    if (baseline && isReferenceFrame(*baseline)) reference = baseline->settings;
    if (!reference) return;
    for (const Settings& s : settings) {
        if (isReference(s.path) || s.msaa == 1) continue;
        if (const std::string problem = samplesProblem(*reference, s); !problem.empty())
            throw std::runtime_error(problem);
        if (!options.channels.empty() && std::ranges::count(options.channels, Channel::lit) == 0)
            refuse("--msaa {}: only lit is compared with the reference; add it to --channels", s.msaa);
    }
}

// Refuses options that a cross-device comparison does not support.
void checkAgainstDevice(const CompareLine& options, const std::vector<Settings>& settings) {
    if (options.against_device.empty()) return;
    if (comparedOf(options).withReference() || !options.baseline_file.empty())
        refuseAgainst(options,
                      "compares each path with itself on another device; leave out --baseline reference or "
                      "FILE.exr");
    if (options.pixel) refuseAgainst(options, "compares whole images; leave out --pixel");
    if (!options.renderers.empty()) refuseAgainst(options, "compares two devices; leave out --renderer");
    checkOneSample(options, settings);
}

// A baseline file is an image of one scene, camera and time.
void checkOneImage(const CompareLine& options, const std::vector<Settings>& settings) {
    if (options.scenes.size() != 1 || settings.size() != 2)
        refuse("--baseline {}: a file holds one view; give one scene, one camera{}",
               options.baseline_file.string(), options.times.size() > 1 ? " and one time" : "");
}

// The Frame that becomes the new baseline: of --path, else of the old baseline's path.
const Frame& renewing(const CompareLine& options, const Frame* old, const ViewFrames& view) {
    const Path path = old && !options.path_requested && !isReference(old->settings.path)
                          ? old->settings.path
                          : options.settings.path;
    if (const Frame* const drawn = view.by(path)) return *drawn;
    refuse("--path {}: compare renders deferred and forward_plus; use one of them", nameOf(path));
}

void noteUnused(const CompareLine& options) {
    if (options.path_requested && !options.update_baseline)
        note(options, "--path is not used: compare renders both");
    if (options.heat)
        note(options, "--heat is not used: the report shows every channel, including light_count");
    if (options.debug_requested) note(options, "--debug is not used: the report shows every channel");
}

// The file of --baseline; empty without one, or if this command writes the first.
std::optional<Frame> readBaseline(const CompareLine& options, const std::vector<Settings>& settings) {
    if (options.baseline_file.empty()) return {};
    checkOneImage(options, settings);
    if (options.update_baseline && !std::filesystem::exists(options.baseline_file)) return {};
    return frameFromExr(options.baseline_file);
}

int compareOneScene(const CompareLine& options, const std::vector<Settings>& settings,
                    std::optional<Frame> baseline, const std::filesystem::path& folder) {
    const ImageChoice image = imageChoice(options);
    CompareOptions compare = compareOptions(options);
    const experiment::Compared compared = comparedOf(options);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    const std::unique_ptr<Device> other = againstDevice(options);
    logVerbose(options, "on " + device.info().name + (other ? " and " + other->info().name : ""));
    ReferenceCheckpoints checkpoints(folder, true);
    RenderOptions render = evaluatedOptions(renderOptions(options), settings, isTraced(settings, baseline),
                                            other != nullptr, options.twice);
    render.keep = checkpoints.opener();
    const std::string& name = options.scenes.front();
    const Stage drawn_stage = Stage(progress, name).part(0, experiment::fractionsOf(render).drawn);
    const double loading = loadingFraction(name, render, settings.size());
    const Scene scene = loadSceneWithSettings(name, options.settings, drawn_stage.part(0, loading));
    if (!options.allow_empty) requireTriangles(scene, name);
    const double drawn_part = loading + compared.pathsFraction() * (1 - loading);
    render.progress = drawn_stage.part(loading, drawn_part);
    experiment::Devices devices(device, other.get(), false);
    experiment::DrawnScene drawn =
        experiment::drawScene(scene, compared, settings, devices, render, drawn_stage.part(drawn_part, 1));
    for (const Device* of : devices.all()) checkValidation(*of);
    std::string updated;
    if (options.update_baseline)
        updated = updateBaseline(options.baseline_file,
                                 renewing(options, baseline ? &*baseline : nullptr, drawn.views.front()),
                                 reportDevice(device));
    const Stage stage(progress, folder.string());
    const auto [drawing, comparing] = experiment::fractionsOf(render);
    compare.progress = stage.part(drawing, comparing);
    Report report = experiment::reportOf(compared, compare, std::move(drawn), std::move(baseline), devices,
                                         againFolder(folder));
    double explained = comparing;
    if (isExplained(options.explain, report)) {
        explained = 0.5 * (1 + comparing);
        addExplanations(explanationOf(options), device, report, stage.part(comparing, explained));
    }
    std::vector<IndexRow> rows;
    for (const Comparison& comparison : report.comparisons) rows.push_back(indexRowOf(report, comparison));
    const auto since = sinceOf(options, report, rows);
    const std::string json = writeReport(report, folder,
                                         {image, options.single_file, options.keep, options.force,
                                          stage.part(explained, 1), std::nullopt, since});
    checkpoints.remove();
    progress.wipe();
    noteLeftByOthers(options, checkpoints);
    printResult(
        options, json,
        fmt::format("{}{}pictures: {}\nreport: {}\n", reportTable(report), sinceText(since.get(), report),
                    exposureLine(report, image), (folder / "index.html").string()));
    if (!updated.empty()) note(options, updated);
    printFirstError(report.errors);
    // The new baseline replaces the old one, so only the last comparison counts.
    const bool passed = options.update_baseline ? report.comparisons.back().passed() : report.passed();
    return exitCode(passed, !report.errors.empty());
}

int runCompare(const CompareLine& requested) {
    if (requested.pixel) {
        checkAgainstDevice(requested, {});
        return runPixel(requested);
    }
    CompareLine options = requested;
    options.scenes = scenesOf(requested.scenes);
    const std::vector<Settings> settings = settingsOf(options, comparedOf(options).paths());
    const std::filesystem::path folder = outputFolder(options, "diptych-report", "report", "report.json");
    noteUnused(options);
    std::optional<Frame> baseline = readBaseline(options, settings);
    checkSamples(options, settings, baseline);
    checkAgainstDevice(options, settings);
    if (!options.since.empty() && !options.shard.empty())
        refuse("--since: a shard does not have all scenes; give --since to merge");
    checkSince(options);
    if (options.scenes.size() > 1 || !options.shard.empty()) return compareMany(options, settings, folder);
    return compareOneScene(options, settings, std::move(baseline), folder);
}

}  // namespace

experiment::Compared comparedOf(const CompareLine& options) {
    return {options.baseline, !options.baseline_file.empty(), options.renderers, options.renderer_texts};
}

ExplanationQuestion explanationOf(const CompareLine& options) {
    return {options.explain, options.settings, options.sides, renderOptions(options), options.image};
}

bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline) {
    const auto traced = [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    };
    return std::ranges::any_of(settings, traced) ||
           (baseline && isReferenceFrame(*baseline) && traced(baseline->settings));
}

void addCompared(CLI::App& app, CompareLine& options, const char* out) {
    addOption(app, "--times", options.settings_text.times, "S,S,...",
              "several animation times in one report, seconds (--time)")
        ->group(pixel_group)
        ->excludes(app.get_option("--time"));
    addFiles(app, options, out);
    addBaseline(app, options,
                "left panel: deferred or forward_plus; with reference or an EXR, both paths are compared "
                "with it (deferred)",
                "PATH|FILE.exr");
    addRenderers(app, options, "another renderer to compare with the left panel");
    addReport(app, options);
}

void addEvaluated(CLI::App& app, CompareLine& options) {
    app.option_defaults()->group(output_group);
    app.add_flag("--update-baseline", options.update_baseline,
                 "replace the --baseline FILE.exr; the old one stays as FILE.exr.old");
    addSelection(app, options);
    addTolerances(app, options);
    addOption(app, "--twice", options.twice_text, "all|lit|none",
              "channels to render a second time; a difference between the two runs is a race (lit)");
    app.add_flag("--allow-noise", options.allow_noise,
                 "on a GPU, add the difference between two runs of one path to its tolerance");
    app.option_defaults()->group(output_group);
    app.add_flag("--explain", options.explain, "name the causes of a lit difference even if it passes");
    addOption(app, "--pixel", options.pixel_text, "X,Y",
              "instead of a report, print one pixel's breakdown: both surfaces, each light's term, the first "
              "step that differs; exit code 0 if that succeeds");
}

void resolveCompare(CompareLine& options) {
    resolveScene(options);
    resolveKeep(options);
    options.twice = valueNamed<Twice>("--twice", options.twice_text,
                                      {{{"all", Twice::all}, {"lit", Twice::lit}, {"none", Twice::none}}});
    resolveBaseline(options);
    if (options.update_baseline &&
        (options.baseline_file.empty() || !imageName(options.baseline_file).part.empty()))
        refuse("--update-baseline: needs --baseline FILE.exr (without ?part=), the file to replace");
    resolveRenderers(options);
    if (options.pixel_text) options.pixel = pixelOf(*options.pixel_text);
    resolveSelection(options);
}

Command compareCommand() {
    return makeCommand<CompareLine>(
        {"compare", "Renders a scene with both paths and compares every channel: table, pictures, verdict",
         "diptych compare helmet.glb --lights point:32 -o helmet-report",
         "gbuffer assign shadows lights camera size baseline tolerances out json"},
        describeCompare, resolveCompare, runCompare);
}

std::vector<std::string> verdictOptions(const CompareLine& options) {
    WordList words;
    words.add("--tolerances", options.tolerances.string());
    words.add("--baseline", options.baseline_file.string());
    words.add("--against-device", options.against_device);
    if (!options.against_device.empty()) words.add("--device", options.device);
    const std::vector<std::string> sides = wordsOf(options.sides);
    words.words.insert(words.words.end(), sides.begin(), sides.end());
    words.add(options.selection);
    words.add("--allow-noise", options.allow_noise);
    words.add("--strict", options.strict);
    words.add("--allow-empty", options.allow_empty);
    return words.words;
}

CompareOptions compareOptions(const CompareLine& options) {
    CompareOptions compare;
    compare.baseline = options.baseline;
    compare.selection = options.selection;
    compare.allow_noise = options.allow_noise;
    compare.strict = options.strict;
    compare.allow_empty = options.allow_empty;
    compare.required = options.channels;
    compare.words = verdictOptions(options);
    compare.light_differs = lightDifferences(options.sides.of(options.settings, drawn_paths[0]),
                                             options.sides.of(options.settings, drawn_paths[1]));
    if (options.tolerances.empty()) return compare;
    compare.rules = readRules(options.tolerances);
    std::vector<std::string> known;
    for (const DebugMode& mode : debugModes()) known.emplace_back(mode.name);
    checkChannels(compare.rules, known);
    return compare;
}

}  // namespace diptych::cli
