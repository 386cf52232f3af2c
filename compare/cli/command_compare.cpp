// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/compare_many.h"
#include "compare/cli/scene_comparison.h"
#include "compare/cli/verdict_words.h"
#include "compare/files/frame_exr.h"
#include "compare/files/output.h"
#include "compare/files/scene_folders.h"
#include "compare/frames/frame_facts.h"
#include "compare/render/reference_frame.h"
#include "compare/report/exposure_line.h"
#include "compare/report/report.h"
#include "compare/run/print.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/pair_reports.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace diptych::cli {
namespace {

// A baseline file is an image of one scene, camera and time.
void checkOnePicture(const Options& options, const std::vector<Settings>& settings) {
    if (options.scenes.size() != 1 || settings.size() != 2)
        throw std::runtime_error(
            fmt::format("--baseline {}: a file holds one view; give one scene, one camera{}",
                        options.baseline_file.string(), options.times.size() > 1 ? " and one time" : ""));
}

// The Frame that becomes the new baseline: of --path, else of the old baseline's path.
const Frame& renewing(const Options& options, const Frame* old, const ViewFrames& view) {
    const Path path = old && !options.path_given && !isReference(old->settings.path) ? old->settings.path
                                                                                     : options.settings.path;
    if (const Frame* const drawn = view.by(path)) return *drawn;
    throw std::runtime_error(
        fmt::format("--path {}: compare renders deferred and forward_plus; use one of them", nameOf(path)));
}

void noteUnused(const Options& options) {
    if (options.path_given && !options.update_baseline)
        note(options, "--path is not used: compare renders both");
    if (options.heat)
        note(options, "--heat is not used: the report shows every channel, including light_count");
    if (options.debug_given) note(options, "--debug is not used: the report shows every channel");
}

// The file of --baseline; empty without one, or if this command writes the first.
std::optional<Frame> readBaseline(const Options& options, const std::vector<Settings>& settings) {
    if (options.baseline_file.empty()) return {};
    checkOnePicture(options, settings);
    if (options.update_baseline && !std::filesystem::exists(options.baseline_file)) return {};
    return frameFromExr(options.baseline_file);
}

int compareOneScene(const Options& options, const std::vector<Settings>& settings,
                    std::optional<Frame> baseline, const std::filesystem::path& folder) {
    const PictureChoice picture = pictureChoice(options);
    CompareOptions compare = compareOptions(options);
    const experiment::Compared compared = comparedOf(options);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    const std::unique_ptr<Device> other = againstDevice(options);
    say(options, "on " + device.info().name + (other ? " and " + other->info().name : ""));
    KeptReferences kept(folder, true);
    RenderOptions render = judgedOptions(renderOptions(options), settings, isTraced(settings, baseline),
                                         other != nullptr, options.twice);
    render.keep = kept.opener();
    const std::string& name = options.scenes.front();
    const Stage drawn_stage = Stage(progress, name).part(0, experiment::sharesOf(render).drawn);
    const double loading = loadingShare(name, render, settings.size());
    const Scene scene = loadShown(name, options.settings, drawn_stage.part(0, loading));
    if (!options.allow_empty) requireTriangles(scene, name);
    const double ours = loading + compared.ourShare() * (1 - loading);
    render.progress = drawn_stage.part(loading, ours);
    experiment::Devices devices(device, other.get(), false);
    experiment::DrawnScene drawn =
        experiment::drawScene(scene, compared, settings, devices, render, drawn_stage.part(ours, 1));
    for (const Device* of : devices.all()) checkValidation(*of);
    std::string updated;
    if (options.update_baseline)
        updated = updateBaseline(options.baseline_file,
                                 renewing(options, baseline ? &*baseline : nullptr, drawn.views.front()),
                                 reportDevice(device));
    const Stage stage(progress, folder.string());
    const auto [drawing, comparing] = experiment::sharesOf(render);
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
                                         {picture, options.single_file, options.keep, options.force,
                                          stage.part(explained, 1), std::nullopt, since});
    kept.remove();
    progress.wipe();
    noteLeftByOthers(options, kept);
    if (options.json)
        printText(json);
    else if (!options.quiet)
        printColored(options, fmt::format("{}{}pictures: {}\nreport: {}\n", reportTable(report),
                                          sinceText(since.get(), report), exposureLine(report, picture),
                                          (folder / "index.html").string()));
    if (!updated.empty()) note(options, updated);
    sayErrors(report.errors);
    if (!report.errors.empty()) return 2;
    // The new baseline replaces the old one, so only the last comparison counts.
    return (options.update_baseline ? report.comparisons.back().passed() : report.passed()) ? 0 : 1;
}

}  // namespace

int runCompare(const Options& given) {
    if (given.pixel) {
        checkAgainstDevice(given, {});
        return runPixel(given);
    }
    Options options = given;
    options.scenes = scenesOf(given.scenes);
    const std::vector<Settings> settings = settingsOf(options, comparedOf(options).paths());
    const std::filesystem::path folder = outputFolder(options, "diptych-report", "report", "report.json");
    noteUnused(options);
    std::optional<Frame> baseline = readBaseline(options, settings);
    checkSamples(options, settings, baseline);
    checkAgainstDevice(options, settings);
    checkSince(options);
    if (options.scenes.size() > 1 || !options.shard.empty()) return compareMany(options, settings, folder);
    return compareOneScene(options, settings, std::move(baseline), folder);
}

}  // namespace diptych::cli
