// SPDX-License-Identifier: MIT
// Pixels of one path that show another surface on another device: rasterisation and depth tests decide there.
#pragma once

#include "compare/verdict/frame_pair.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// Channels by which surfacePixels() knows a surface; both Frames need them.
std::vector<int> surfacePixelChannels();

// Pixels of two pictures that show something else each, and may: beside an edge, which two devices place a
// step of their sub-pixel grids apart, or where two surfaces have one depth.
struct SurfacePixels {
    struct Differing {
        std::uint64_t count = 0;   // pixels
        std::uint64_t edges = 0;   // pixels beside an edge in either picture
        std::uint64_t most = 0;    // so many of them may differ
        std::uint64_t strays = 0;  // pixels that do and are not beside an edge
        int x = -1, y = -1;        // the first of these
    };
    std::vector<std::uint8_t> others;  // 1 per pixel that differs
    Differing triangles;               // another triangle is seen
    Differing shadows;                 // the same surface in another shadow
    std::uint64_t tied = 0;            // another surface of the same depth, of which the scene has two there

    std::uint64_t count() const { return triangles.count + shadows.count + tied; }
    std::string fault() const;  // empty where all of it is allowed
    std::string inWords() const;
};
SurfacePixels surfacePixels(const FramePair& pair);

}  // namespace diptych
