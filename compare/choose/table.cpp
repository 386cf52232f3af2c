// SPDX-License-Identifier: MIT
#include "compare/choose/table.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace diptych::choose {

namespace {

constexpr std::size_t unusual = static_cast<std::size_t>(-1);

// Index in the list, from 1; `unusual` if not in the list.
std::size_t placeOf(const Change& change) {
    std::size_t place = 0;
    const auto has = [&](std::string_view option, std::string_view values) {
        ++place;
        return change.option == option &&
               (values == "*" ||
                ("," + std::string(values) + ",").find("," + change.value + ",") != std::string::npos);
    };
#define X(option, values) \
    if (has(option, values)) return place;
    DIPTYCH_DEFAULT_CHANGES(X)
#undef X
    return unusual;
}

}  // namespace

std::vector<Change> changesBetween(const Settings& from, const Settings& to) {
    std::vector<Change> changes;
    for (const Field& field : settingFields())
        if (std::string value = to.valueOf(field.option); value != from.valueOf(field.option))
            changes.push_back({to.path, std::string(field.option), std::move(value)});
    return changes;
}

std::vector<Settings> tableOf(std::span<const Settings> candidates) {
    if (candidates.size() <= mostInTable) return {candidates.begin(), candidates.end()};
    std::map<Path, const Settings*> firsts;
    std::vector<std::pair<std::size_t, const Settings*>> placed;
    for (const Settings& candidate : candidates) {
        const Settings& first = *firsts.try_emplace(candidate.path, &candidate).first->second;
        const std::vector<Change> changes = changesBetween(first, candidate);
        if (changes.size() > 1) continue;
        const std::size_t place = changes.empty() ? 0 : placeOf(changes.front());
        if (place != unusual) placed.emplace_back(place, &candidate);
    }
    std::ranges::stable_sort(placed, {}, &std::pair<std::size_t, const Settings*>::first);
    placed.resize(std::min(placed.size(), mostInTable));
    std::vector<Settings> table;
    for (const auto& [place, candidate] : placed) table.push_back(*candidate);
    return table;
}

}  // namespace diptych::choose
