// SPDX-License-Identifier: MIT
#include "compare/command_words.h"

#include "compare/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace diptych {
namespace {

bool isPlain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-+=:,./@%").find(c) != std::string_view::npos;
}

// In single quotes where the shell would see more in it than a word; a quote itself stands outside of them.
std::string shellWord(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, isPlain)) return word;
    std::string quoted = "'";
    for (const char c : word)
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    return quoted + "'";
}

}  // namespace

std::vector<std::string> wordsOf(const std::string& command, const std::string& scene,
                                 const Settings& settings) {
    std::vector<std::string> words{command};
    const Settings usual;
    Settings::fields(settings, [&](const Field& field, const auto&) {
        const std::string value = valueOf(settings, field.option);
        if (value == valueOf(usual, field.option) || (command == "compare" && field.option == "path")) return;
        const std::string option = "--" + std::string(field.option);
        if (value.starts_with('-')) return words.push_back(option + "=" + value);
        words.push_back(option);
        words.push_back(value);
    });
    if (scene.starts_with('-')) words.emplace_back("--");  // a file's name, no option
    words.push_back(scene);
    return words;
}

std::vector<std::string> with(std::vector<std::string> words, const std::string& option,
                              const std::string& value) {
    words.insert(words.begin() + 1,
                 {option, value});  // before the scene, after which "--" may have ended options
    return words;
}

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.begin() + 1, more.begin(), more.end());
    return words;
}

std::string shellLine(const std::vector<std::string>& words) {
    std::string line = "diptych";
    for (const std::string& word : words) line += " " + shellWord(word);
    return line;
}

std::string commandOf(const std::string& command, const std::string& scene, const Settings& settings) {
    return shellLine(wordsOf(command, scene, settings));
}

namespace {

// "--option value" for what is not as usual; numbers with all their digits.
class Words {
public:
    template <class T>
    void add(const char* option, const T& value, const T& usual) {
        if (value != usual) put(option, value);
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

void addSelection(Words& words, const SelectionOptions& selection) {
    words.add("--mask", selection.mask, std::string());
    if (!selection.ids.empty())
        words.words.insert(words.words.end(), {"--ids", fmt::format("{}", fmt::join(selection.ids, ","))});
    words.add("--ignore-edges", selection.ignore_edges, 0);
    if (selection.crop)
        words.words.insert(words.words.end(),
                           {"--crop", fmt::format("{},{},{}x{}", selection.crop->x, selection.crop->y,
                                                  selection.crop->width, selection.crop->height)});
}

}  // namespace

std::vector<std::string> wordsOfWhatCounts(const Options& options) {
    Words words;
    words.add("--tolerances", options.tolerances.string(), std::string());
    if (options.command == "diff") {
        const PictureDiffOptions &diff = options.diff, usual;
        words.add("--metric", diff.metric, usual.metric);
        if (std::isfinite(diff.tolerance)) words.add("--tolerance", diff.tolerance, usual.tolerance);
        words.add("--warn", diff.warn);
        words.add("--failing", diff.failing);
        for (const std::string& name : diff.names) words.words.insert(words.words.end(), {"--map", name});
        words.add("--blur", diff.blur, 0.0);
        words.add("--shift", diff.shift, 0);
        words.add("--ppd", diff.flip.pixels_per_degree, usual.flip.pixels_per_degree);
        words.add("--start-exposure", diff.flip.start_exposure);
        words.add("--stop-exposure", diff.flip.stop_exposure);
        words.add("--exposures", diff.flip.exposures);
        addSelection(words, diff.selection);
        return words.words;
    }
    words.add("--baseline", options.baseline_file.string(), std::string());
    addSelection(words, options.selection);
    if (options.allow_noise) words.words.emplace_back("--allow-noise");
    return words.words;
}

}  // namespace diptych
