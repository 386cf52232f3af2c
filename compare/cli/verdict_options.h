// SPDX-License-Identifier: MIT
// Words of options that influence a verdict (rules, pixels, metric), without scene, camera and Settings.
#pragma once

#include "compare/verdict/selection.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

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

}  // namespace diptych::cli
