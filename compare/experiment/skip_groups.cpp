// SPDX-License-Identifier: MIT
#include "compare/experiment/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::experiment {
namespace {

// A skip's reason without the tried value and the suggestion, so that it is equal for all values.
// "--msaa-edges all has no effect without --msaa 4; use exact" becomes "has no effect without --msaa 4".
struct Cause {
    std::string reason, option, value;  // no option: the whole combination
};

Cause causeOf(const SweepSkip& skip) {
    for (const auto& [option, value] : skip.tried) {
        const std::string named = fmt::format("--{} {}", option, value);
        if (!skip.reason.starts_with(named + " ")) continue;
        const std::string rest = skip.reason.substr(named.size() + 1);
        return {rest.substr(0, rest.rfind("; use ")), option, value};
    }
    const bool single = skip.tried.size() == 2 && skip.tried.front().option == "path";
    return single ? Cause{skip.reason, skip.tried.back().option, skip.tried.back().value}
                  : Cause{skip.reason, "", inWords(skip.tried)};
}

}  // namespace

std::vector<SkipGroup> groupsOf(const std::vector<SweepSkip>& skips) {
    std::vector<Cause> causes;
    for (const SweepSkip& skip : skips) causes.push_back(causeOf(skip));
    std::vector<SkipGroup> groups;
    for (const Cause& cause : causes) {
        if (std::ranges::count(groups, cause.reason, &SkipGroup::reason) > 0) continue;
        SkipGroup group{cause.reason, {}};
        std::vector<std::pair<std::string, std::vector<std::string>>> values;  // key: option
        for (const Cause& other : causes) {
            if (other.reason != cause.reason) continue;
            auto known = std::ranges::find(values, other.option, [](const auto& v) { return v.first; });
            if (known == values.end()) known = values.insert(values.end(), {other.option, {}});
            if (std::ranges::count(known->second, other.value) == 0) known->second.push_back(other.value);
        }
        for (const auto& [option, tried] : values)
            if (option.empty())
                group.tried.insert(group.tried.end(), tried.begin(), tried.end());
            else
                group.tried.push_back(fmt::format("{} {}", option, fmt::join(tried, "|")));
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace diptych::experiment
