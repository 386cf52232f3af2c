// SPDX-License-Identifier: MIT
#include "compare/commands.h"
#include "compare/picture_diff.h"
#include "compare/picture_diff_report.h"
#include "compare/report/picture_diff_text.h"

#include <fmt/format.h>

namespace diptych {

int runDiff(const Options& options) {
    const std::optional<Output> output =
        options.out.empty() ? std::nullopt : std::optional(outputOf(options.out));
    if (output) checkReplaceable(*output, "report.json", options.force);
    PictureDiffOptions settings = options.diff;
    if (!options.tolerances.empty()) settings.rules = readRules(options.tolerances);
    const PictureDiff diff = diffPictures(options.scenes.at(0), options.scenes.at(1), settings);
    if (output) writePictureDiff(diff, *output, {options.picture, options.single_file, options.force});
    if (options.json)
        fmt::print("{}", pictureDiffJson(diff));
    else if (!options.quiet)
        fmt::print("{}", pictureDiffTable(diff));
    return diff.passed() ? 0 : 1;
}

}  // namespace diptych
