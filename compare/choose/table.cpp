// SPDX-License-Identifier: MIT
#include "compare/choose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace diptych::choose {

namespace {

// Options and values; "*" is any. Most relevant first: the table drops the last ones if it is full.
constexpr std::pair<const char*, const char*> usualChanges[] = {
    {"assign", "every,tiled,clustered"},       // light lists cost time and save it with many lights
    {"gbuffer", "compact,standard,full"},      // bytes per pixel or normal error
    {"size", "*"},                             // fewer pixels: less time, more error
    {"shadows", "off,pcf,evsm,msm4,clipmap"},  // directional shadow filters
    {"prepass", "on,off"},                     // saves time with overdraw
    {"transparency", "sorted,unsorted,weighted,moments"},
    {"msaa", "1,4"},
    {"msaa-edges", "all,exact,similar,coverage"},
    {"ibl", "split,sampled"},
    {"ibl-diffuse", "sh,map"},
    {"shadow-size", "512,1024"},
    {"shadow-lights", "0,1,4"},
    {"area-lights", "ltc,representative"},
    {"light-cutoff", "0,0.01"},
    {"specular-albedo", "table,fit"},
    {"skinning", "compute,vertex"},
    {"lit-format", "fp16"},
    {"lighting", "compute"}};

// Index in the list, from 1; past its end if it is not there.
std::ptrdiff_t tableIndexOf(const Change& change) {
    const auto* const found = std::ranges::find_if(usualChanges, [&](const auto& usual) {
        const std::string values = fmt::format(",{},", usual.second);
        return change.option == usual.first &&
               (values == ",*," || values.find("," + change.value + ",") != std::string::npos);
    });
    return found - usualChanges + 1;
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
    if (candidates.size() <= maxInTable) return {candidates.begin(), candidates.end()};
    std::map<Path, const Settings*> firsts;
    std::vector<std::pair<std::ptrdiff_t, const Settings*>> indexed;
    for (const Settings& candidate : candidates) {
        const Settings& first = *firsts.try_emplace(candidate.path, &candidate).first->second;
        const std::vector<Change> changes = changesBetween(first, candidate);
        if (changes.size() > 1) continue;
        const std::ptrdiff_t index = changes.empty() ? 0 : tableIndexOf(changes.front());
        if (index <= std::ssize(usualChanges)) indexed.emplace_back(index, &candidate);
    }
    std::ranges::stable_sort(indexed, {}, &std::pair<std::ptrdiff_t, const Settings*>::first);
    indexed.resize(std::min(indexed.size(), maxInTable));
    std::vector<Settings> table;
    for (const auto& [index, candidate] : indexed) table.push_back(*candidate);
    return table;
}

}  // namespace diptych::choose
