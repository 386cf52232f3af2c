// SPDX-License-Identifier: MIT
// Where that lies which is drawn or casts shadows.
#pragma once

#include "shared/draw/geometry.h"
#include "shared/scene/motion/bounds.h"

#include <glm/mat4x4.hpp>

#include <array>

namespace diptych {

std::array<glm::dvec3, 8> cornersOf(const Bounds& bounds);
// Of a primitive's box, transformed.
std::array<glm::dvec3, 8> cornersOf(const PrimitiveRange& range, const glm::dmat4& fromObject);

// World space, of every instance.
Bounds boundsOf(const Pose& pose, const Geometry& geometry);

}  // namespace diptych
