// SPDX-License-Identifier: MIT
// Bounds of the scene's geometry.
#pragma once

#include "shared/draw/geometry.h"
#include "shared/scene/motion/bounds.h"

#include <glm/mat4x4.hpp>

#include <array>

namespace diptych {

std::array<glm::dvec3, 8> cornersOf(const Bounds& bounds);
// Corners of a primitive's transformed box.
std::array<glm::dvec3, 8> cornersOf(const PrimitiveRange& range, const glm::dmat4& fromObject);

// Bounds of all instances, world space.
Bounds boundsOf(const Pose& pose, const Geometry& geometry);

}  // namespace diptych
