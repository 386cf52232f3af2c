// SPDX-License-Identifier: MIT
// Permitted error of a path that approximates an environment's light, which the reference integrates.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>
#include <string>

namespace diptych {

// As a fraction of environment light reflected by the specular lobe. Linear interpolation between widths
// half an octave apart is off by 6 % if one point emits all light, because its peak is proportional to the
// squared width. Interpolation between nodes is off by 1.6 %.
inline constexpr double filteredFraction = 0.08;
// As the same fraction, times the root of the number of samples: the error of sampling at every pixel. 64
// samples were off by 14 % at one pixel in a thousand under a city's sun, and by 21 % under a lamp of 5
// degrees, 400 times as bright as the sky.
inline constexpr double sampledFraction = 2;

class EnvironmentCost {
public:
    // `pair` must outlive it.
    explicit EnvironmentCost(const FramePair& pair);

    // Whether the reference has errors of the approximations, and the other side is a path.
    bool any() const { return costs_ != nullptr; }
    // Permitted errors of a channel at the pixel, in its unit; 0 for channels that the environment does not
    // light.
    double allowed(const DebugMode& mode, std::size_t pixel) const {
        return allowedDiffuse(mode, pixel) + allowedSpecular(mode, pixel);
    }
    double allowedDiffuse(const DebugMode& mode, std::size_t pixel) const;
    double allowedSpecular(const DebugMode& mode, std::size_t pixel) const;
    // Reason of the tolerance for this channel.
    std::string because(const DebugMode& mode) const;

private:
    const Image* costs_ = nullptr;  // Frame::environment_costs
    const Settings* settings_ = nullptr;
};

}  // namespace diptych
