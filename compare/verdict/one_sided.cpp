// SPDX-License-Identifier: MIT
#include "compare/verdict/one_sided.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

void judgeOneSided(const OneSidedChannel& channel, const ChannelDemands& demands,
                   std::vector<std::string>& failures, std::vector<std::string>& notes) {
    const std::string alone = fmt::format("{} is in {} only", channel.name, channel.owner);
    const Rule* rule = ruleFor(demands.rules, channel.name);
    if (rule && namesChannels(*rule))
        failures.push_back(fmt::format("{}, but {} needs both sides", alone, rule->origin));
    else if (std::ranges::count(demands.names, channel.name) > 0)
        failures.push_back(fmt::format("{}, but --channels requests it", alone));
    else if (demands.all)
        failures.push_back(alone + ", but --strict requires the same channels on both sides");
    else
        notes.push_back(alone + ": not compared");
}

}  // namespace diptych
