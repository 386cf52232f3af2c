// SPDX-License-Identifier: MIT
// What a sweep tries of each of the Settings.
#include "shared/frame/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace diptych {
namespace {

std::vector<std::string> split(std::string_view list, char separator) {
    std::vector<std::string> words;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(separator), list.size());
        words.emplace_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return words;
}

bool readWhole(std::string_view text, int& value) {
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && rest == text.data() + text.size() && !text.empty();
}

}  // namespace

std::string wordsFor(const Settings& given, std::string_view option, const std::string& word) {
    const std::size_t slash = word.find('/');
    int part = 0, whole = 0;
    if (option != "size" || slash == std::string::npos ||
        !readWhole(std::string_view(word).substr(0, slash), part) ||
        !readWhole(std::string_view(word).substr(slash + 1), whole) || part < 1 || whole < 1)
        return word;
    const auto side = [&](int pixels) {
        return std::max(std::llround(static_cast<double>(pixels) * part / whole), 1LL);
    };
    return fmt::format("{}x{}", side(given.size.width), side(given.size.height));
}

std::vector<std::string> sweptValues(const Settings& given, std::string_view option) {
    std::vector<std::string> words;
    bool found = false;
    Settings::fields(given, [&](const Field& field, const auto&) {
        if (field.option != option) return;
        found = true;
        words = field.sweep == "all" ? split(acceptedValues(option), '|') : split(field.sweep, ',');
    });
    if (!found) throw std::runtime_error(fmt::format("--{}: no such setting", option));
    for (std::string& word : words) word = wordsFor(given, option, word);
    return words;
}

}  // namespace diptych
