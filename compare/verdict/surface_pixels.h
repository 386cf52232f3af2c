// SPDX-License-Identifier: MIT
// Pixels of one path that show another surface on another device, decided by rasterisation and depth
// tests.
#pragma once

#include "compare/verdict/frame_pair.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// Channels by which surfacePixels() identifies a surface; both Frames need them.
std::vector<Channel> surfacePixelChannels();

// Pixels that show different surfaces in two images and may: beside an edge, which two devices place a
// step of their subpixel grids apart, or where two surfaces have equal depth.
struct SurfacePixels {
    struct Differing {
        std::uint64_t count = 0;   // pixels that differ
        std::uint64_t edges = 0;   // pixels beside an edge in either image
        std::uint64_t max = 0;     // the largest permitted number
        std::uint64_t strays = 0;  // pixels that differ and are not beside an edge
        int x = -1, y = -1;        // the first stray
    };
    std::vector<std::uint8_t> others;  // 1 for each pixel that differs
    Differing triangles;               // another triangle is visible
    Differing shadows;                 // the same surface with another shadow
    std::uint64_t tied = 0;            // another surface of equal depth; the scene has two there

    std::uint64_t count() const { return triangles.count + shadows.count + tied; }
    std::string fault() const;  // empty if all of it is permitted
    std::string describe() const;
};
SurfacePixels surfacePixels(const FramePair& pair);

}  // namespace diptych
