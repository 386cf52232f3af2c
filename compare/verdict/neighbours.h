// SPDX-License-Identifier: MIT
// Neighbouring pixels, and the difference of two pixels in a channel's unit.
#pragma once

#include "compare/metrics/pixel.h"
#include "compare/verdict/frame_pair.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace diptych {

inline constexpr double degreesPerRadian = 180 / std::numbers::pi;

inline std::size_t indexOf(const Image& image, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
}

// Visits the pixels at most `radius` rows and columns away, and the pixel itself: visit(index, dx, dy).
template <class Visit>
void within(const Image& image, std::size_t pixel, int radius, const Visit& visit) {
    const int x = static_cast<int>(pixel) % image.width, y = static_cast<int>(pixel) / image.width;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u)
            visit(indexOf(image, u, v), u - x, v - y);
}

// Difference of two values in the unit of ranges: degrees for directions, else the largest component
// difference.
inline double channelDifference(const DebugMode& mode, const float* a, const float* b) {
    return mode.error_kind == ErrorKind::angular ? metrics::angle(a, b)
           : mode.error_kind == ErrorKind::axial ? metrics::lineAngle(a, b)
                                                 : metrics::distance(a, b, mode.width);
}

// Whether neighbours show the same surface, by material, position and normal; without these channels all
// do.
class SurfaceAround {
public:
    explicit SurfaceAround(const Frame& frame)
        : ids_(findChannel(frame, Channel::material_id)),
          normals_(findChannel(frame, Channel::geometric_normal)),
          positions_(findChannel(frame, Channel::position)) {}

    bool sameMaterial(std::size_t i, std::size_t j) const {
        return !ids_ || *ids_->pixel(i) == *ids_->pixel(j);
    }
    // Whether neighbour `j` lies within 30 degrees of the plane of pixel `i`.
    bool same(std::size_t i, std::size_t j) const {
        if (!sameMaterial(i, j)) return false;
        if (!positions_ || !normals_) return true;
        const float *n = normals_->pixel(i), *p = positions_->pixel(i), *q = positions_->pixel(j);
        double across = 0, length = 0;
        for (int c = 0; c < 3; ++c) {
            const double between = double{q[c]} - double{p[c]};
            across += double{n[c]} * between;
            length += between * between;
        }
        return across * across <= 0.25 * length;
    }
    // Angle between their triangles' normals, degrees.
    double normalAngle(std::size_t i, std::size_t j) const {
        return normals_ ? metrics::angle(normals_->pixel(i), normals_->pixel(j)) : 0;
    }

private:
    const Image *ids_, *normals_, *positions_;
};

}  // namespace diptych
