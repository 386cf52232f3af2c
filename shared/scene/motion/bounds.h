// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/motion/pose.h"

#include <glm/vec3.hpp>

#include <limits>

namespace diptych {

// An axis-aligned box in world space, m.
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(min.x <= max.x); }
    glm::dvec3 centre() const { return (min + max) * 0.5; }
    double radius() const;  // m, of the sphere around centre() through the corners; 0 if empty
};

Bounds worldBounds(const Scene& scene, const Pose& pose);  // over every posed vertex of every instance
// The bounds at 0 s, whatever the pose's time: lights and cameras placed around a scene do not move with it.
Bounds boundsAtStart(const Scene& scene, const Pose& pose);

}  // namespace diptych
