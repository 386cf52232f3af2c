// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"
#include "tests/fuzz/fuzz.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace diptych::fuzz {

// Postconditions of scene.h for a light of any source. Aborts with the violated one.
inline void requireSound(const Light& light) {
    const auto isSize = [](float x) { return x > 0 && std::isfinite(x); };
    require(std::isfinite(glm::dot(light.position, light.position)), "a position is finite");
    require(std::abs(glm::length(light.direction) - 1) < 1e-12, "a direction is of unit length");
    require(std::abs(glm::length(light.axis) - 1) < 1e-12, "an axis is of unit length");
    require(light.kind != LightKind::rect || std::abs(glm::dot(light.axis, light.direction)) < 1e-9,
            "a rect's axis is at right angles to its direction");
    require(light.intensity >= 0 && std::isfinite(light.intensity), "intensity is finite");
    for (int c = 0; c < 3; ++c)
        require(light.color[c] >= 0 && std::isfinite(light.color[c]), "colour is finite");
    require(light.range > 0, "a range is above 0");
    require(light.inner_cone >= 0 && light.inner_cone <= light.outer_cone, "a cone ends within its edge");
    require(light.angle >= 0 && light.angle <= gpu::PI, "a sun's disc is at most half of all directions");
    require(light.angle == 0 || light.kind == LightKind::directional, "only suns have a disc");
    require(isSize(light.width) && isSize(light.height) && isSize(light.radius) && isSize(light.length),
            "sizes are above 0");
}

}  // namespace diptych::fuzz
