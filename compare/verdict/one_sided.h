// SPDX-License-Identifier: MIT
// Verdict on a channel that only one of two images has.
#pragma once

#include "compare/files/layers.h"
#include "compare/verdict/rules.h"

#include <span>
#include <string>
#include <vector>

namespace diptych {

// Demands for a channel on both sides.
struct ChannelDemands {
    std::span<const Rule> rules{};     // each demands the channels that it names
    std::vector<std::string> names{};  // --channels: these
    bool all = false;                  // --strict: every channel
};

// Adds a line to `failures` if the channel is demanded on both sides, else to `notes`.
void judgeOneSided(const OneSidedChannel& channel, const ChannelDemands& demands,
                   std::vector<std::string>& failures, std::vector<std::string>& notes);

}  // namespace diptych
