// SPDX-License-Identifier: MIT
// A ground with balls of many meshlets, for culling tests.
#pragma once

#include "tests/image/shadow_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace diptych::tests {

// A ball of meshlets, twice in the same place: the last triangle drawn is visible.
inline Primitive ballTwice(int of_material, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(-1, 1);
    constexpr int rings = 14;
    Primitive ball;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i <= 2 * rings; ++i) {
            const float phi = 3.14159265f * static_cast<float>(j) / rings,
                        theta = 3.14159265f * static_cast<float>(i) / rings;
            const glm::vec3 at(std::sin(phi) * std::cos(theta), std::cos(phi),
                               -std::sin(phi) * std::sin(theta));
            ball.positions.push_back(at * (1 + 0.1f * part(random)));
            ball.normals.push_back(at);
            ball.tangents.emplace_back(-std::sin(theta), 0, -std::cos(theta), 1);
            ball.texcoords[0].emplace_back(part(random), part(random));
        }
    const auto at = [&](int j, int i) { return static_cast<std::uint32_t>(j * (2 * rings + 1) + i); };
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < 2 * rings; ++i)
            ball.indices.insert(ball.indices.end(), {at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i),
                                                     at(j + 1, i + 1), at(j, i + 1)});
    const std::vector<std::uint32_t> once = ball.indices;
    const std::size_t corners = ball.positions.size();
    for (std::size_t i = 0; i < corners; ++i) {
        ball.positions.push_back(ball.positions[i]);
        ball.normals.push_back(-ball.normals[i]);
        ball.tangents.push_back(ball.tangents[i]);
        ball.texcoords[0].push_back(-ball.texcoords[0][i]);
    }
    for (const std::uint32_t index : once)
        ball.indices.push_back(static_cast<std::uint32_t>(corners) + index);
    ball.material = of_material;
    return ball;
}

// Mirrored, flattened, double-sided, nested, partly out of view, and coincident balls.
inline Scene placedBalls(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    Scene scene = groundUnder(sunAt(40));
    scene.meshes.push_back({"ball", {ballTwice(1, seed)}});
    scene.materials[1].double_sided = seed % 3 == 0;
    for (int i = 0; i < 12; ++i) {
        const double size = 0.1 + 0.4 * std::abs(part(random));
        const glm::dvec3 at(3 * part(random), 0.8 + part(random), 3 * part(random)),
            scale((i % 3 == 1 ? -1 : 1) * size, (i % 4 == 2 ? 0.1 : 1) * size, size);
        scene.nodes.push_back(
            {"ball", -1,
             glm::scale(glm::rotate(glm::translate(glm::dmat4(1), at), part(random), glm::dvec3(0.6, 0, 0.8)),
                        scale),
             1});
    }
    return scene;
}

}  // namespace diptych::tests
