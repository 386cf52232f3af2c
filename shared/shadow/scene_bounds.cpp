// SPDX-License-Identifier: MIT
#include "shared/shadow/scene_bounds.h"

namespace diptych {

std::array<glm::dvec3, 8> cornersOf(const Bounds& bounds) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = {(i & 1 ? bounds.max : bounds.min).x, (i & 2 ? bounds.max : bounds.min).y,
                      (i & 4 ? bounds.max : bounds.min).z};
    return corners;
}

std::array<glm::dvec3, 8> cornersOf(const PrimitiveRange& range, const glm::dmat4& fromObject) {
    Bounds bounds;
    bounds.min = range.bounds_min;
    bounds.max = range.bounds_max;
    std::array<glm::dvec3, 8> corners = cornersOf(bounds);
    for (glm::dvec3& corner : corners) corner = fromObject * glm::dvec4(corner, 1);
    return corners;
}

Bounds boundsOf(const Pose& pose, const Geometry& geometry) {
    Bounds bounds;
    for (const Instance& instance : pose.instances) {
        const PlacedPrimitive placed = geometry.placed(pose, instance);
        if (placed.range.index_count == 0) continue;
        for (const glm::dvec3& corner : cornersOf(placed.range, placed.world_from_object)) {
            bounds.min = glm::min(bounds.min, corner);
            bounds.max = glm::max(bounds.max, corner);
        }
    }
    return bounds;
}

}  // namespace diptych
