// SPDX-License-Identifier: MIT
// Words of options that influence a verdict (rules, pixels, metric), without scene, camera and Settings.
#pragma once

#include "compare/cli/command_compare.h"
#include "compare/verdict/comparison.h"

#include <fmt/format.h>

#include <initializer_list>

namespace diptych::cli {

// Collects "--option value" for options that differ from their defaults. Numbers keep all digits.
class WordList {
public:
    template <class T>
    void add(const char* option, const T& value, const T& defaults = T()) {
        if (value != defaults) put(option, fmt::format("{}", value));
    }
    template <class T>
    void add(const char* option, const std::optional<T>& value) {
        if (value) put(option, fmt::format("{}", *value));
    }
    void add(const char* flag, bool value) {
        if (value) words.emplace_back(flag);
    }
    void add(const SelectionOptions& selection);
    std::vector<std::string> words;

private:
    void put(const char* option, const std::string& value);
};

std::vector<std::string> wordsOfWhatCounts(const CompareLine& options);

// Options of `compare` that influence a verdict. Reads the rules; throws std::runtime_error, one line, if
// they are invalid or name an unknown channel.
CompareOptions compareOptions(const CompareLine& options);

}  // namespace diptych::cli
