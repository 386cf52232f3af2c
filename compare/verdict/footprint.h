// SPDX-License-Identifier: MIT
// Compares a path with the reference's own materials, textures and camera (mode scene). Different filters
// (a mip level against the mean over the pixel) are no error of either. They only matter where an image
// changes from pixel to pixel. So pixels with smooth surroundings in both images each have a bound, and
// the others are compared together by FLIP.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace diptych {

// Largest mean FLIP of pixels with detail. Two valid filters (trilinear, and the mean over the pixel's
// footprint) reach at most 0.25 in scenes made to alias, 0.03 to 0.13 in others. A different or shifted
// texture reaches 0.4 and more (MEASURED.md).
inline constexpr double detailFlip = 0.3;

struct Footprints {
    std::uint64_t smooth = 0;  // pixels with a bound of their own
    std::uint64_t glass = 0;   // of these: light through rough or refracting glass
    std::uint64_t beyond = 0;  // smooth pixels out of tolerance
    // Error over the bound at 99.9 % of the smooth pixels, with or without those of glass, whichever is more.
    double used = 0;
    int x = -1, y = -1;          // smooth pixel with the highest use
    double max = 0;              // largest bound, in the channel's error kind
    std::uint64_t detailed = 0;  // pixels compared by FLIP
    double flip = 0;             // mean FLIP of these
    std::uint64_t edges = 0;     // pixels not compared: of geometry and ids

    std::uint64_t pixels() const { return smooth + detailed + edges; }
    double closeFraction() const;  // fraction of pixels with a bound of their own; 1 without pixels
};

// If fewer pixels have bounds of their own, FLIP alone decides, and passes even 0.3 of the light.
inline constexpr double minCloseFraction = 0.01;

// Channels by which footprints() identifies a surface in two images. Both need all of them, whichever are
// compared.
std::vector<Channel> footprintChannels();

// Their tolerance for people: the largest bound, and its reason.
Tolerance footprintTolerance(const Footprints& footprints);

// Result of a channel against a reference in mode scene; empty for other pairs.
std::optional<Footprints> footprints(const DebugMode& mode, const FramePair& pair);

}  // namespace diptych
