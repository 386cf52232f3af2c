// SPDX-License-Identifier: MIT
// Simple primitives.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/geometric.hpp>

namespace diptych {

// A parallelogram from `corner` along x and y, facing cross(x, y). uv is (0, 0) at corner + y.
inline Primitive rectangle(const glm::vec3& corner, const glm::vec3& x, const glm::vec3& y,
                           int material = 0) {
    Primitive p;
    p.positions = {corner, corner + x, corner + x + y, corner + y};
    p.normals.assign(4, glm::normalize(glm::cross(x, y)));
    p.tangents.assign(4, {1, 0, 0, 1});
    p.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

// From the origin, 1 m along x and y, facing +Z.
inline Primitive triangleOfAMetre() {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.normals.assign(3, {0, 0, 1});
    p.tangents.assign(3, {1, 0, 0, 1});
    p.indices = {0, 1, 2};
    return p;
}

}  // namespace diptych
