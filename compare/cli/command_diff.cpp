// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/verdict_words.h"
#include "compare/files/picture_folders.h"
#include "compare/report/picture_diff_report.h"
#include "compare/run/print.h"
#include "compare/verdict/picture_diff.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace diptych::cli {

// Fraction of the time spent on reading and measuring; writing takes the rest.
constexpr double measuring = 0.9;

namespace {

// Bytes per pixel allocated for writing while the images are in memory, measured. A folder needs the
// images, their errors and one float image; else a PNG.
double outputBytes(const std::optional<Output>& output) {
    if (!output || output->kind == OutputKind::exr) return 0;
    return output->kind == OutputKind::folder ? 13 : 4;
}

void print(const Options& options, const std::string& text) {
    if (options.json)
        printText(text);
    else if (!options.quiet)
        printColored(options, text);
}

// Compares all images whose names exist in both folders.
int diffFolders(const Options& options, PictureDiffOptions settings, const std::optional<Output>& output) {
    namespace fs = std::filesystem;
    if (output && output->kind != OutputKind::folder)
        throw std::runtime_error(fmt::format(
            "-o {}: comparing two folders writes a report folder; give a name without an extension",
            output->path.string()));
    FolderDiff diff{options.scenes.at(0), options.scenes.at(1), {}, {}, {}, {}};
    const fs::path left = diff.reference, right = diff.test;
    PictureFolders folders = pictureFolders(left, right);
    Progress progress(progressOutput(options));
    const Stage stage(progress, diff.test);
    const auto all = static_cast<double>(folders.both.size());
    for (std::size_t i = 0; i < folders.both.size(); ++i) {
        const std::string& name = folders.both[i];
        const auto done = static_cast<double>(i);
        settings.progress = stage.part(measuring * done / all, measuring * (done + 1) / all).about(name);
        try {
            diff.pictures.push_back(diffPictures((left / name).string(), (right / name).string(), settings));
            diff.pictures.back().name = name;
        } catch (const std::system_error&) {
            throw;  // errors of this machine, such as a full disk, end the command
        } catch (const std::runtime_error& error) {
            diff.errors.push_back({name, error.what()});
        }
    }
    if (diff.pictures.empty())
        throw std::runtime_error(fmt::format("none of {} can be compared; the first: {}",
                                             counted(folders.both.size(), "image"),
                                             diff.errors.front().message));
    diff.reference_alone = std::move(folders.reference_alone);
    diff.test_alone = std::move(folders.test_alone);
    const bool passed = diff.passed();
    const std::string text = options.json ? folderDiffJson(diff) : folderDiffTable(diff);
    if (output)
        writePictureDiffs(std::move(diff.pictures), output->path,
                          {pictureChoice(options), options.single_file, options.keep, options.force,
                           stage.part(measuring, 1)},
                          wordsOfWhatCounts(options), diff.errors, diff.failures());
    progress.wipe();
    print(options, text);
    sayErrors(diff.errors);
    return !diff.errors.empty() ? 2 : passed ? 0 : 1;
}

}  // namespace

int runDiff(const Options& options) {
    const std::optional<Output> output =
        options.out.empty() ? std::nullopt : std::optional(outputOf(options.out));
    if (output) checkReplaceable(*output, "report.json", options.force);
    PictureDiffOptions settings = options.diff;
    settings.strict = options.strict;
    settings.allow_empty = options.allow_empty;
    settings.output_bytes = outputBytes(output);
    if (!options.tolerances.empty()) settings.rules = readRules(options.tolerances);
    const auto isFolder = [&](std::size_t i) {
        std::error_code ignored;  // diffPictures() reports unreadable files
        return std::filesystem::is_directory(options.scenes.at(i), ignored);
    };
    if (isFolder(0) && isFolder(1)) return diffFolders(options, std::move(settings), output);
    Progress progress(progressOutput(options));
    const Stage stage(progress, options.scenes.at(1));
    settings.progress = stage.part(0, measuring);
    PictureDiff diff = diffPictures(options.scenes.at(0), options.scenes.at(1), settings);
    stage.at(measuring, "write");
    const bool passed = diff.passed();
    const std::string text = options.json ? pictureDiffJson(diff) : pictureDiffTable(diff);
    if (output)
        writePictureDiff(std::move(diff), *output,
                         {pictureChoice(options), options.single_file, options.keep, options.force,
                          stage.part(measuring, 1)},
                         wordsOfWhatCounts(options));
    progress.wipe();
    print(options, text);
    return passed ? 0 : 1;
}

}  // namespace diptych::cli
