// SPDX-License-Identifier: MIT
// A sun, the ground and objects on it, with known shadow positions.
#pragma once

#include "tests/image/scenes.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace diptych::tests {

// A sun `degrees` above the horizon, towards +X and a little +Z.
inline Light sunAt(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return sunAlong(
        -glm::dvec3(std::cos(angle) * std::cos(0.3), std::sin(angle), std::cos(angle) * std::sin(0.3)), 3);
}

// The ground, 8 m x 8 m around the origin, with objects on it, seen from above.
inline Scene groundUnder(const Light& sun, std::vector<Primitive> standing = {}, double scale = 1) {
    Scene scene;
    scene.name = "ground";
    std::vector<Primitive> all{rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})};
    for (Primitive& p : standing) all.push_back(std::move(p));
    for (Primitive& p : all)
        for (glm::vec3& position : p.positions) position *= static_cast<float>(scale);
    scene.meshes.push_back({"ground", std::move(all)});
    scene.nodes.push_back({"ground", -1, glm::dmat4(1.0), 0});
    scene.materials.resize(3);
    scene.materials[0].double_sided = scene.materials[1].double_sided = scene.materials[2].double_sided =
        true;
    scene.lights.push_back(sun);
    Camera camera;
    camera.near = 0.1 * scale;
    camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(0.4, 6, 2.5) * scale, glm::dvec3(0), {0, 1, 0}));
    scene.cameras.push_back(camera);
    return scene;
}

// An upright board above the origin, as wide as the ground and 1 m high; its foot is on the ground's
// centre line.
inline Primitive board(int material = 0) {
    return rectangle({0, 0, 4}, {0, 0, -8}, {0, 1, 0}, material);
}

}  // namespace diptych::tests
