// SPDX-License-Identifier: MIT
// The channels (debug modes) as an enumeration.
#pragma once

#include "shared/contract/debug_mode.h"

#include <optional>

namespace diptych {

// One enumerator for each row of DEBUG_MODES, by its name. Its value is the channel's index.
#define DIPTYCH_DEBUG_CHANNEL(index, name, width, errorKind, kind, domain, supported_by, shows, stage, step, \
                              code, standard, compact, part, texels, related)                                \
    name = index,
enum class Channel : int { DEBUG_MODES(DIPTYCH_DEBUG_CHANNEL) };
#undef DIPTYCH_DEBUG_CHANNEL

// The index in JSON, in shaders and on the command line.
constexpr int channelIndex(Channel channel) {
    return static_cast<int>(channel);
}
std::optional<Channel> channelOfIndex(int index);  // empty: no channel has this index

// Tells a file's layers apart that are none of these channels. They have no row in debugModes().
constexpr Channel foreignChannel(int index) {
    constexpr int above = 1000;
    return Channel{above + index};
}

}  // namespace diptych
