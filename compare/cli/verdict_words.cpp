// SPDX-License-Identifier: MIT
#include "compare/cli/verdict_words.h"

#include "compare/cli/options.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

namespace diptych::cli {
namespace {

// Collects "--option value" for options that differ from their defaults. Numbers keep all digits.
class WordList {
public:
    template <class T>
    void add(const char* option, const T& value, const T& defaults) {
        if (value != defaults) put(option, value);
    }
    template <class T>
    void add(const char* option, const std::optional<T>& value) {
        if (value) put(option, *value);
    }
    std::vector<std::string> words;

private:
    template <class T>
    void put(const char* option, const T& value) {
        const std::string text = fmt::format("{}", value);
        if (text.starts_with('-'))
            words.push_back(fmt::format("{}={}", option, text));
        else
            words.insert(words.end(), {option, text});
    }
};

void addSelection(WordList& words, const SelectionOptions& selection) {
    words.add("--mask", selection.mask, std::string());
    if (!selection.ids.empty())
        words.words.insert(words.words.end(), {"--ids", fmt::format("{}", fmt::join(selection.ids, ","))});
    words.add("--ignore-edges", selection.ignore_edges, 0);
    if (selection.crop)
        words.words.insert(words.words.end(),
                           {"--crop", fmt::format("{},{},{}x{}", selection.crop->x, selection.crop->y,
                                                  selection.crop->width, selection.crop->height)});
}

void addFlags(WordList& words, const Options& options) {
    if (options.strict) words.words.emplace_back("--strict");
    if (options.allow_empty) words.words.emplace_back("--allow-empty");
}

}  // namespace

std::vector<std::string> wordsOfWhatCounts(const Options& options) {
    WordList words;
    words.add("--tolerances", options.tolerances.string(), std::string());
    if (options.command == "diff") {
        const PictureDiffOptions &diff = options.diff, defaults;
        words.add("--metric", diff.metric, defaults.metric);
        if (std::isfinite(diff.tolerance)) words.add("--tolerance", diff.tolerance, defaults.tolerance);
        words.add("--warn", diff.warn);
        words.add("--failing", diff.failing);
        for (const std::string& name : diff.names) words.words.insert(words.words.end(), {"--map", name});
        words.add("--blur", diff.blur, 0.0);
        words.add("--shift", diff.shift, 0);
        words.add("--ppd", diff.flip.pixels_per_degree, defaults.flip.pixels_per_degree);
        words.add("--start-exposure", diff.flip.start_exposure);
        words.add("--stop-exposure", diff.flip.stop_exposure);
        words.add("--exposures", diff.flip.exposures);
        addSelection(words, diff.selection);
        addFlags(words, options);
        return words.words;
    }
    const std::vector<std::string> sides = wordsOf(options.sides);
    words.add("--baseline", options.baseline_file.string(), std::string());
    words.add("--against-device", options.against_device, std::string());
    if (!options.against_device.empty()) words.add("--device", options.device, std::string());
    words.words.insert(words.words.end(), sides.begin(), sides.end());
    addSelection(words, options.selection);
    if (options.allow_noise) words.words.emplace_back("--allow-noise");
    addFlags(words, options);
    return words.words;
}

CompareOptions compareOptions(const Options& options) {
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
