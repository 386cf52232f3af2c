// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/verdict_words.h"
#include "compare/report/picture_diff_report.h"
#include "compare/report/picture_diff_text.h"
#include "compare/verdict/picture_diff.h"

#include <fmt/format.h>

namespace diptych::cli {

// The share of reading and measuring; the rest is writing.
constexpr double measuring = 0.9;

int runDiff(const Options& options) {
    const std::optional<Output> output =
        options.out.empty() ? std::nullopt : std::optional(outputOf(options.out));
    if (output) checkReplaceable(*output, "report.json", options.force);
    PictureDiffOptions settings = options.diff;
    settings.strict = options.strict;
    settings.allow_empty = options.allow_empty;
    if (!options.tolerances.empty()) settings.rules = readRules(options.tolerances);
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
    if (options.json)
        fmt::print("{}", text);
    else if (!options.quiet)
        printColored(options, text);
    return passed ? 0 : 1;
}

}  // namespace diptych::cli
