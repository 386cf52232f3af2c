// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace diptych {

// Normalizes `v`; returns `fallback` if its length is zero or not finite.
inline glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : fallback;
}

// Any unit vector perpendicular to the unit vector `v`.
inline glm::dvec3 perpendicularTo(const glm::dvec3& v) {
    const glm::dvec3 axis = std::abs(v.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(v, axis));
}

}  // namespace diptych
