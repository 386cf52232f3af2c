// SPDX-License-Identifier: MIT
// The surface that is seen around each pixel in two pictures of one path on two devices.
#pragma once

#include "compare/verdict/across_devices.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/neighbours.h"

#include <cstdint>
#include <vector>

namespace diptych {

// The sum of both devices' steps of a grid of `bits`.
double stepOf(const AcrossDevices& across, unsigned DevicePrecision::*bits);

// The relative error of a value that both devices interpolate.
double relativeRounding();

// Pixels of a radian at the pixel's depth.
double pixelsPerRadian(const Frame& frame, std::size_t i);

// Calls visit(pixel, bit) for the pixels around one.
template <class Visit>
void aroundPixel(const Image& image, std::size_t pixel, const Visit& visit) {
    const auto width = static_cast<std::size_t>(image.width);
    const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    around(image, x, y, [&](int u, int v) {
        const int place = (v - y + 1) * 3 + (u - x + 1);
        visit(indexOf(image, u, v), 1u << (place > 4 ? place - 1 : place));
    });
}
// Bits of the neighbours across and down.
inline constexpr unsigned across_bits = 1u << 3 | 1u << 4, down_bits = 1u << 1 | 1u << 6;

// The largest angle between the normals of one triangle, degrees: its places are rounded as parts of their
// distance, and both pictures pack it.
class FacetBound {
public:
    explicit FacetBound(const FramePair& pair);
    double operator()(std::size_t i) const;

private:
    const Frame& frame_;
    double packed_;
};

// The neighbours of each pixel in both pictures, found once for all channels of a pair.
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

}  // namespace diptych
