// SPDX-License-Identifier: MIT
// Tiles and froxels, and the regions that lights reach, as exact shapes in double precision. Culling is
// compared with them.
#pragma once

#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace diptych {

// Froxel in view axes: slopes of its sides (x / depth, y / depth), and depths.
struct Cell {
    glm::dvec2 x, y, z;

    std::array<glm::dvec3, 8> corners() const {
        std::array<glm::dvec3, 8> result;
        for (int i = 0; i < 8; ++i) {
            const double depth = z[(i >> 2) & 1];
            result[static_cast<std::size_t>(i)] = {x[i & 1] * depth, y[(i >> 1) & 1] * depth, depth};
        }
        return result;
    }
    bool holds(const glm::dvec3& p) const {
        return p.z >= z.x && p.z <= z.y && p.x >= x.x * p.z && p.x <= x.y * p.z && p.y >= y.x * p.z &&
               p.y <= y.y * p.z;
    }
};

inline glm::dvec3 nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                    const glm::dvec3& c) {
    // Ericson 2004, "Real-Time Collision Detection", 5.1.5: by Voronoi regions of the triangle.
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                 d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

inline glm::dvec3 nearestInCell(const glm::dvec3& p, const Cell& cell) {
    if (cell.holds(p)) return p;
    const auto c = cell.corners();
    constexpr std::size_t faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    glm::dvec3 best = c[0];
    for (const auto& face : faces) {
        const glm::dvec3 q = nearestOnTriangle(p, c[face[0]], c[face[1]], c[face[2]]);
        if (glm::distance(p, q) < glm::distance(p, best)) best = q;
    }
    return best;
}

// Region lit by a point light (sphere) or a spot (spherical sector).
struct LitRegion {
    glm::dvec3 apex, axis;
    double range = 1, half = glm::pi<double>();  // half: half angle of the cone, rad

    glm::dvec3 nearest(const glm::dvec3& p) const {
        const glm::dvec3 v = p - apex;
        const double length = glm::length(v);
        if (length == 0) return apex;
        const double along = glm::dot(v, axis);
        if (half < 3 && along < length * std::cos(half)) {
            // On the cone's side, or the apex.
            glm::dvec3 across = v - axis * along;
            across = glm::length(across) > 0 ? glm::normalize(across) : glm::dvec3(0);
            const glm::dvec3 side = axis * std::cos(half) + across * std::sin(half);
            return apex + side * std::clamp(glm::dot(v, side), 0.0, range);
        }
        return length > range ? apex + v * (range / length) : p;
    }
};

// Distance of the two convex sets, by alternating projections (Cheney and Goldstein 1959, "Proximity maps
// for convex sets") from several starting points. Negative if not converged.
inline double gap(const LitRegion& region, const Cell& cell) {
    const auto corners = cell.corners();
    double min = std::numeric_limits<double>::infinity();
    const glm::dvec3 middle = (corners[0] + corners[7]) * 0.5;
    glm::dvec3 p = nearestInCell(region.apex, cell);
    if (glm::distance(p, region.nearest(p)) > glm::distance(middle, region.nearest(middle))) p = middle;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 q = region.nearest(p);
        p = nearestInCell(q, cell);
        min = glm::distance(p, q);
        if (min < 1e-13 || (i % 50 == 49 && before - min < 1e-12 * region.range)) return min;
        if (i % 50 == 49) before = min;
    }
    return -1;
}

}  // namespace diptych
