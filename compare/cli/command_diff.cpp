// SPDX-License-Identifier: MIT
#include "compare/cli/command_diff.h"
#include "compare/cli/exit_code.h"

#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/verdict_options.h"
#include "compare/files/image_folders.h"
#include "compare/report/image_diff_json.h"
#include "compare/report/image_diff_report.h"
#include "shared/text/counted.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace diptych::cli {

namespace {

void describeDiff(CLI::App& app, DiffLine& options) {
    ImageDiffOptions& diff = options.diff;
    addOption(app, "images", options.images, "A B", "reference and test image")->expected(2)->required();
    app.option_defaults()->group(selection_group);
    addOption(app, "--metric", options.metric_text, "NAME",
              "metric for the verdict: flip, rmse, max, relative, psnr, ssim, ulp, ... (flip)");
    addOption(
        app, "--tolerance", options.tolerance_requested, "T",
        "largest metric value that passes; for psnr and ssim the smallest (none: only equal values pass)");
    addOption(app, "--warn", diff.warn, "T", "warn beyond this value");
    addOption(app, "--failing", diff.failing, "SHARE",
              "instead of --metric: fraction of pixels whose error may exceed the tolerance")
        ->check(CLI::Range(0.0, 1.0));
    addList(app, "--channels", diff.channels, "NAME,...",
            "names of the channels to compare, * and ? allowed (all)");
    addEach(app, "--map", diff.names, "NAME=CHANNEL,...",
            "Diptych's names for another renderer's channels; repeatable");
    addOption(app, "--blur", diff.blur, "PIXELS",
              "blur both pictures first, standard deviation in pixels (0)")
        ->check(CLI::Range(0.0, 100.0));
    addOption(app, "--shift", diff.shift, "PIXELS", "allow features to move by up to this many pixels (0)")
        ->check(CLI::Range(0, 16));
    addOption(app, "--ppd", diff.flip.pixels_per_degree, "F",
              "FLIP: pixels per degree of the view (67.0206)");
    addOption(app, "--start-exposure", diff.flip.start_exposure, "STOPS",
              "HDR-FLIP: the darkest exposure, stops (from the reference)");
    addOption(app, "--stop-exposure", diff.flip.stop_exposure, "STOPS",
              "HDR-FLIP: the brightest exposure, stops");
    addOption(app, "--exposures", diff.flip.exposures, "N", "HDR-FLIP: number of exposures")
        ->check(CLI::Range(1, 1000));
    addSelection(app, options);
    addTolerances(app, options);
    addReport(app, options);
    addFiles(app, options,
             "X.exr: errors of every channel; X.png: errors of the deciding channel; any other name: report "
             "folder; without -o: no files");
    addOutput(app, options);
}

void resolveDiff(DiffLine& options) {
    ImageDiffOptions& diff = options.diff;
    refuseLineBreaks(options.images);
    resolveKeep(options);
    resolveSelection(options);
    diff.selection = options.selection;
    diff.strict = options.strict;
    diff.allow_empty = options.allow_empty;
    diff.metric_requested = !options.metric_text.empty();
    diff.metric = metricOfOption(diff.metric_requested ? options.metric_text : "flip");
    if (diff.failing && diff.metric_requested)
        refuse("--failing: counts pixels by the channel's own error; leave out --metric");
    if (!std::isfinite(diff.blur)) refuse("--blur: must be a finite number of pixels");
    const Metric& metric = *findMetric(diff.metric);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double identity = !metric.more_is_better ? 0 : metric.name == "ssim" ? 1 : infinity;
    diff.tolerance = options.tolerance_requested.value_or(identity);
    diff.tolerance_requested = options.tolerance_requested.has_value();
    if (std::isnan(diff.tolerance) || (diff.tolerance < 0 && !metric.more_is_better))
        refuse("--tolerance {}: must be 0 or more", diff.tolerance);
    if (diff.failing && !diff.tolerance_requested)
        refuse("--failing: needs --tolerance T, the error above which a pixel fails");
}

// Fraction of the time spent on reading and measuring; writing takes the rest.
constexpr double measuring = 0.9;

// Bytes per pixel allocated for writing while the images are in memory, measured. A folder needs the
// images, their errors and one float image; else a PNG.
double outputBytes(const std::optional<Output>& output) {
    if (!output || output->kind == OutputKind::exr) return 0;
    return output->kind == OutputKind::folder ? 13 : 4;
}

// Compares all images whose names exist in both folders.
void diffFolders(FolderDiff& diff, ImageDiffOptions settings, const Stage& stage) {
    namespace fs = std::filesystem;
    const fs::path left = diff.reference, right = diff.test;
    ImageFolders folders = imageFolders(left, right);
    const auto all = static_cast<double>(folders.both.size());
    for (std::size_t i = 0; i < folders.both.size(); ++i) {
        const std::string& name = folders.both[i];
        const auto done = static_cast<double>(i);
        settings.progress = stage.part(measuring * done / all, measuring * (done + 1) / all).about(name);
        try {
            diff.images.push_back(diffImages((left / name).string(), (right / name).string(), settings));
            diff.images.back().name = name;
        } catch (const std::system_error&) {
            throw;  // errors of this machine, such as a full disk, end the command
        } catch (const std::runtime_error& error) {
            diff.errors.push_back({name, error.what()});
        }
    }
    if (diff.images.empty())
        refuse("none of {} can be compared; the first: {}", counted(folders.both.size(), "image"),
               diff.errors.front().message);
    diff.reference_alone = std::move(folders.reference_alone);
    diff.test_alone = std::move(folders.test_alone);
}

int runDiff(const DiffLine& options) {
    const std::optional<Output> output =
        options.out.empty() ? std::nullopt : std::optional(outputOf(options.out));
    if (output) checkReplaceable(*output, "report.json", options.force);
    ImageDiffOptions settings = options.diff;
    settings.output_bytes = outputBytes(output);
    if (!options.tolerances.empty()) settings.rules = readRules(options.tolerances);
    const bool folders = std::ranges::all_of(options.images, [](const std::string& name) {
        std::error_code ignored;  // diffImages() reports unreadable files
        return std::filesystem::is_directory(name, ignored);
    });
    const bool asReport = output && output->kind == OutputKind::folder;
    if (folders && output && !asReport)
        refuse("-o {}: comparing two folders writes a report folder; give a name without an extension",
               output->path.string());
    FolderDiff diff{options.images.at(0), options.images.at(1), {}, {}, {}, {}};
    Progress progress(progressOutput(options));
    const Stage stage(progress, diff.test);
    if (folders) {
        diffFolders(diff, std::move(settings), stage);
    } else {
        settings.progress = stage.part(0, measuring);
        diff.images.push_back(diffImages(diff.reference, diff.test, settings));
        stage.at(measuring, "write");
    }
    const std::string text = !options.json ? diffTable(diff.images, diff.errors, diff.failures())
                             : folders     ? folderDiffJson(diff)
                                           : imageDiffJson(diff.images.front());
    const bool passed = diff.passed();
    if (asReport)
        writeDiffs(diff.images, output->path,
                   {{}, options.single_file, options.keep, options.force, stage.part(measuring, 1)},
                   verdictOptions(options), diff.errors, diff.failures());
    else if (output)
        writeDiffErrors(diff.images.front(), *output);
    progress.wipe();
    printResult(options, text, text);
    printFirstError(diff.errors);
    return exitCode(passed, !diff.errors.empty());
}

}  // namespace

std::vector<std::string> verdictOptions(const DiffLine& options) {
    const ImageDiffOptions &diff = options.diff, defaults;
    WordList words;
    words.add("--tolerances", options.tolerances.string());
    words.add("--metric", diff.metric, defaults.metric);
    if (std::isfinite(diff.tolerance)) words.add("--tolerance", diff.tolerance, defaults.tolerance);
    words.add("--warn", diff.warn);
    words.add("--failing", diff.failing);
    for (const std::string& name : diff.names) words.add("--map", std::optional(name));
    words.add("--blur", diff.blur);
    words.add("--shift", diff.shift);
    words.add("--ppd", diff.flip.pixels_per_degree, defaults.flip.pixels_per_degree);
    words.add("--start-exposure", diff.flip.start_exposure);
    words.add("--stop-exposure", diff.flip.stop_exposure);
    words.add("--exposures", diff.flip.exposures);
    words.add(options.selection);
    words.add("--strict", options.strict);
    words.add("--allow-empty", options.allow_empty);
    return words.words;
}

Command diffCommand() {
    return makeCommand<DiffLine>(
        {"diff", "Compares any two EXR, PNG, JPEG, TIFF, HDR or PFM images from any renderer",
         "diptych diff reference.exr test.exr --metric flip --tolerance 0.01 -o difference",
         "metric tolerance failing channels map mask crop tolerances out json"},
        describeDiff, resolveDiff, runDiff);
}

}  // namespace diptych::cli
