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
    double radius() const;  // m, of the bounding sphere around centre(); 0 if empty
};

Bounds worldBounds(const Scene& scene, const Pose& pose);  // of all posed vertices of all instances
// The bounds at 0 s, whatever the pose's time, so that lights and cameras placed by them do not move.
Bounds boundsAtStart(const Scene& scene, const Pose& pose);

}  // namespace diptych
