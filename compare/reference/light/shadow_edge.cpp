// SPDX-License-Identifier: MIT
#include "compare/reference/light/shadow_edge.h"

#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych::reference {

double edgeDistance(const SeesLight& sees, const glm::dvec3& position, const glm::dvec3& normal,
                    const glm::dvec3& to_light, double farthest) {
    constexpr int directions = 8, bisections = 4;
    constexpr double min = 0x1p-13;
    // A straight boundary is at most half the angle between directions away from the nearest of them.
    const double straight = std::cos(std::numbers::pi / directions);
    const glm::dvec3 x = perpendicularTo(to_light), y = glm::cross(to_light, x);
    const double first = min * glm::length(position), cosine = glm::dot(normal, to_light);
    const bool here = sees(position);
    const auto differs = [&](const glm::dvec3& across) {
        return sees(position + across - to_light * (glm::dot(normal, across) / cosine)) != here;
    };
    // Every other ring is rotated by half the angle between directions.
    double rotation = 0;
    for (double radius = first; radius > 0 && radius <= 2 * farthest;
         radius *= 2, rotation = 0.5 - rotation) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int i = 0; i < directions; ++i) {
            const double angle = (i + rotation) * 2 * std::numbers::pi / directions;
            const glm::dvec3 outwards = x * std::cos(angle) + y * std::sin(angle);
            double out = radius, in = radius == first ? 0 : out / 2;
            if (!differs(outwards * out)) continue;
            for (int step = 0; step < bisections; ++step) {
                const double middle = (in + out) / 2;
                (differs(outwards * middle) ? out : in) = middle;
            }
            nearest = std::min(nearest, in * straight);
        }
        if (nearest <= radius) return nearest;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace diptych::reference
