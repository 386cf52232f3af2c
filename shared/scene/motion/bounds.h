// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/motion/pose.h"

#include <glm/vec3.hpp>

#include <limits>

namespace diptych {

// A box in world space, m.
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(min.x <= max.x); }
    glm::dvec3 centre() const { return (min + max) * 0.5; }
    double radius() const;  // of the sphere around centre(); 0 where empty
};

Bounds worldBounds(const Scene& scene, const Pose& pose);  // over every vertex of every instance, posed
// Those at 0 s, whenever the pose is: what is laid out around a scene stays while it moves.
Bounds boundsAtStart(const Scene& scene, const Pose& pose);

}  // namespace diptych
