// SPDX-License-Identifier: MIT
// Visible surfaces around each pixel in two images of one path on two devices.
#pragma once

#include "compare/verdict/across_devices.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/neighbours.h"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych {

// Sum of both devices' steps of a grid of `bits`.
double stepOf(const std::array<DevicePrecision, 2>& devices, unsigned DevicePrecision::*bits);

// Relative error of a value that both devices interpolate.
double relativeRounding();

// Pixels per radian at the pixel's depth.
double pixelsPerRadian(const Frame& frame, std::size_t i);

// Calls visit(pixel, bit) for the pixels around one.
template <class Visit>
void aroundPixel(const Image& image, std::size_t pixel, const Visit& visit) {
    within(image, pixel, 1, [&](std::size_t j, int dx, int dy) {
        const int index = (dy + 1) * 3 + dx + 1;
        if (j != pixel) visit(j, 1u << (index > 4 ? index - 1 : index));
    });
}
// Bits of the neighbours across (left, right) and down (above, below).
inline constexpr unsigned across_bits = 1u << 3 | 1u << 4, down_bits = 1u << 1 | 1u << 6;

// Largest angle between normals of one triangle, degrees: positions round relative to their distance, and
// both images pack the normal.
class FacetBound {
public:
    explicit FacetBound(const FramePair& pair);
    double operator()(std::size_t i) const;

private:
    const Frame& frame_;
    double packed_;
};

// Neighbours of each pixel in both images, found once for all channels of a pair.
class SurfaceGrid {
public:
    explicit SurfaceGrid(const FramePair& pair);

    // Neighbour bits: those that show the same surface, and the same material.
    std::vector<std::uint8_t> surface, material;
    // 1 if along one axis no neighbour shows the pixel's triangle, so that no change across it is visible.
    std::vector<std::uint8_t> narrow;
    // How much steeper the pixel's triangle is than its neighbours show; at least 1.
    std::vector<float> steeper;
};

}  // namespace diptych
