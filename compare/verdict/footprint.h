// SPDX-License-Identifier: MIT
// A path against the reference's own materials, textures and camera (mode scene). What the two filter
// differently (a mip level here, the mean over the pixel there) is no fault of either, but it can only show
// where a picture changes from pixel to pixel. So a pixel whose surroundings are smooth in both pictures is
// held to a bound each, and the others are judged together, as the eye sees them.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace diptych {

// Mean FLIP that pixels with detail may have. Two sound filters (trilinear, and the mean over the pixel's
// footprint) come to 0.25 at most in scenes made to alias, 0.03 to 0.13 in others; another texture, or one
// that lies elsewhere, comes to 0.4 and more (MEASURED.md).
inline constexpr double detailFlip = 0.3;

struct Footprints {
    std::uint64_t smooth = 0;    // pixels held to a bound of their own
    std::uint64_t beyond = 0;    // of these, beyond it
    double used = 0;             // the error over that bound, at 99.9 % of the smooth pixels
    int x = -1, y = -1;          // the smooth pixel that uses most
    double most = 0;             // the largest bound, in the channel's metric
    std::uint64_t detailed = 0;  // pixels judged by FLIP
    double flip = 0;             // its mean over them
    std::uint64_t edges = 0;     // pixels that neither judges: of channels that are no picture

    double closeShare() const;  // of all pixels, those held to a bound of their own; 1 where there are none
};

// A verdict of fewer pixels held to bounds of their own is one of FLIP alone, which 0.3 of light passes.
inline constexpr double leastCloseShare = 0.01;

// The channels by which footprints() knows one surface in two pictures: both need all of them, whichever are
// compared.
std::vector<int> footprintChannels();

// What they are held to, for people: the largest bound, and why.
Tolerance footprintTolerance(const Footprints& footprints);

// How a channel is judged against a reference in mode scene; empty for other pairs.
std::optional<Footprints> footprints(const DebugMode& mode, const FramePair& pair);

}  // namespace diptych
