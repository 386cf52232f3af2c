// SPDX-License-Identifier: MIT
#include "shared/text/indexed_names.h"

#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace diptych {

std::string indexedNames(std::span<const std::string> names) {
    constexpr std::size_t shown = 20;  // about one screen
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), shown); ++i)
        list += fmt::format("{}{}{}", i ? ", " : "", i,
                            names[i].empty() ? "" : fmt::format(" \"{}\"", oneLine(names[i])));
    if (names.size() > shown) list += fmt::format(" and {} more", names.size() - shown);
    return list;
}

bool isIndex(const std::string& choice) {
    return choice.find_first_not_of("0123456789", choice.starts_with('-')) == choice.npos;
}

std::optional<std::size_t> indexOfNamed(const std::string& choice,
                                        std::span<const std::vector<std::string>> names,
                                        std::string_view who) {
    if (isIndex(choice)) {
        std::size_t index = names.size();
        std::from_chars(choice.data(), choice.data() + choice.size(), index);
        return index < names.size() ? std::optional(index) : std::nullopt;
    }
    std::optional<std::size_t> first;
    std::string several;
    bool ambiguous = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::ranges::count(names[i], choice) == 0) continue;
        const std::string item =
            fmt::format("{} ({})", i, oneLine(fmt::format("{}", fmt::join(names[i], ", "))));
        several += (several.empty() ? "" : ", ") + item;
        ambiguous = first.has_value();
        first = first.value_or(i);
    }
    if (ambiguous) fail(std::string(who), fmt::format("is the name of {}; give an index", several));
    return first;
}

std::optional<std::size_t> indexOfNamed(const std::string& choice, std::span<const std::string> names,
                                        std::string_view who) {
    std::vector<std::vector<std::string>> single;
    for (const std::string& name : names) single.push_back({name});
    return indexOfNamed(choice, single, who);
}

}  // namespace diptych
