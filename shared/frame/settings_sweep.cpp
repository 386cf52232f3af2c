// SPDX-License-Identifier: MIT
// Values that a sweep tries.
#include "shared/frame/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace diptych {
namespace {

std::vector<std::string_view> split(std::string_view list, char separator) {
    std::vector<std::string_view> words;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(separator), list.size());
        words.push_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return words;
}

bool readWhole(std::string_view text, int& value) {
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && rest == text.data() + text.size() && !text.empty();
}

}  // namespace

std::string wordsFor(const Settings& requested, std::string_view option, const std::string& word) {
    const std::size_t slash = word.find('/');
    int part = 0, whole = 0;
    if (option != "size" || slash == std::string::npos ||
        !readWhole(std::string_view(word).substr(0, slash), part) ||
        !readWhole(std::string_view(word).substr(slash + 1), whole) || part < 1 || whole < 1)
        return word;
    const auto side = [&](int pixels) {
        return std::max(std::llround(static_cast<double>(pixels) * part / whole), 1LL);
    };
    return fmt::format("{}x{}", side(requested.size.width), side(requested.size.height));
}

std::vector<std::string> sweptValues(const Settings& requested, std::string_view option) {
    const Field& field = settingField(option);
    const bool isAll = field.sweep == "all";
    const std::string list = isAll ? acceptedValues(option) : std::string(field.sweep);
    std::vector<std::string> words;
    for (const std::string_view word : split(list, isAll ? '|' : ','))
        words.push_back(wordsFor(requested, option, std::string(word)));
    return words;
}

std::vector<SweepPair> sweepPairs() {
    std::vector<SweepPair> pairs;
    for (const Field& field : settingFields())
        for (const std::string_view other : split(field.sweep_with, ','))
            pairs.push_back(other == "*" ? SweepPair{field.option, other} : SweepPair{other, field.option});
    return pairs;
}

}  // namespace diptych
