// SPDX-License-Identifier: MIT
// What a path that approximates an environment's light may differ by from the reference, which integrates it.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>
#include <string>

namespace diptych {

// Of what the specular lobe sends of the environment: linear interpolation between widths half an octave
// apart is off by 6 % where one point gives all light (its peak goes with the width's square), between nodes
// by 1.6 %.
inline constexpr double filteredShare = 0.08;
// Of the same: what samples at every pixel are off by, times the root of their number. 64 were off by 14 % at
// one pixel in a thousand under a city's sun, by 21 % under a lamp of 5 degrees, 400 times as bright as the
// sky.
inline constexpr double sampledShare = 2;

class EnvironmentCost {
public:
    // `pair` outlives it.
    explicit EnvironmentCost(const FramePair& pair);

    // Whether the reference says what approximations cost, and the other is a path.
    bool any() const { return costs_ != nullptr; }
    // By how much a channel may be off at the pixel, in its own unit; 0 of channels that the environment does
    // not light.
    double allowed(const DebugMode& mode, std::size_t pixel) const;
    // For whom it is granted, of this channel.
    std::string because(const DebugMode& mode) const;

private:
    const Image* costs_ = nullptr;  // Frame::environment_costs
    const Settings* settings_ = nullptr;
};

}  // namespace diptych
