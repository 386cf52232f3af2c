// SPDX-License-Identifier: MIT
// The channels (debug modes) as an enumeration.
#pragma once

#include "shared/contract/debug_mode.h"

#include <optional>

namespace diptych {

// One enumerator for each row of DEBUG_MODES, by its name. Its value is the channel's number.
#define DIPTYCH_DEBUG_CHANNEL(number, name, width, errorKind, kind, domain, maker, shows, stage, step, code, \
                              standard, compact, part, texels, related)                                      \
    name = number,
enum class Channel : int { DEBUG_MODES(DIPTYCH_DEBUG_CHANNEL) };
#undef DIPTYCH_DEBUG_CHANNEL

// The number in JSON, in shaders and on the command line.
constexpr int channelNumber(Channel channel) {
    return static_cast<int>(channel);
}
std::optional<Channel> channelOfNumber(int number);  // empty: no channel has this number

// Tells a file's layers apart that are none of these channels. They have no row in debugModes().
constexpr Channel foreignChannel(int index) {
    constexpr int above = 1000;
    return Channel{above + index};
}

}  // namespace diptych
