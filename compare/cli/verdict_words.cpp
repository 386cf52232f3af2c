// SPDX-License-Identifier: MIT
#include "compare/cli/verdict_words.h"

#include "shared/frame/debug_modes.h"

#include <fmt/ranges.h>

namespace diptych::cli {

void WordList::put(const char* option, const std::string& value) {
    if (value.starts_with('-'))
        words.push_back(fmt::format("{}={}", option, value));
    else
        words.insert(words.end(), {option, value});
}

void WordList::add(const SelectionOptions& selection) {
    add("--mask", selection.mask);
    if (!selection.ids.empty()) put("--ids", fmt::format("{}", fmt::join(selection.ids, ",")));
    add("--ignore-edges", selection.ignore_edges);
    if (const auto& crop = selection.crop)
        put("--crop", fmt::format("{},{},{}x{}", crop->x, crop->y, crop->width, crop->height));
}

std::vector<std::string> wordsOfWhatCounts(const CompareLine& options) {
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
    compare.words = wordsOfWhatCounts(options);
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
