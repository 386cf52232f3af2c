// SPDX-License-Identifier: MIT
// One path on two devices: which pixels show the same surface in both pictures, and how far apart what those
// show may be, by the precision that Vulkan promises of each device.
#pragma once

#include "compare/render/device_precision.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// What the two pictures are judged with beside their channels.
struct AcrossDevices {
    std::array<DevicePrecision, 2> devices;  // the baseline's and the test's
    // By channel of the surface, the range of the texels that may be seen at a pixel (texel_ranges.h).
    std::map<int, Image> texels;
    // Of forward+ on both, which tells seams of texture coordinates that a deferred Frame does not show;
    // nullptr: unknown.
    std::array<const Image*, 2> texcoords{};
    // Whether the scene has a surface of a material (-1: of any that is blended) so near to a place, which is
    // from the camera, world axes, m; or `several`. Empty: unknown, and no two surfaces are taken for being
    // of one depth.
    std::function<bool(int material, const float* place, double near, bool several)> surface_at{};
    // Lit channels of the test's surfaces as the baseline's device lights them, from their channels.
    std::map<int, Image> relit;
};

// What is seen around each pixel, in both pictures: found once for all channels of a pair.
class SurfaceGrid {
public:
    explicit SurfaceGrid(const FramePair& pair);

    // Neighbours by bit: those that show the same surface, and the same material.
    std::vector<std::uint8_t> surface, material;
    // Neither side of the pixel shows its triangle, so that what changes on that is seen nowhere.
    std::vector<std::uint8_t> narrow;
    // By how much the pixel's triangle is steeper than what its neighbours show of it; at least 1.
    std::vector<float> steeper;
};

// The channels by which surfacePixels() knows a surface; both Frames need them.
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

// How much a channel uses of what the two devices' precision allows at each covered pixel.
EncodingUse deviceUse(const DebugMode& mode, const FramePair& pair);

// The largest tolerance of a pixel, with the reason.
Tolerance deviceTolerance(const DebugMode& mode, const FramePair& pair, const EncodingUse& use);

}  // namespace diptych
