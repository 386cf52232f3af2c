// SPDX-License-Identifier: MIT
// The many-light benchmark, defined by the numbers in spheres.md so that other renderers can be measured on
// the same work. If a number changes, the scene needs a new name.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/lights/rig.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::builtin {

void spheres(Builder& b, std::uint32_t lights) {
    b.scene.background = {0.02f, 0.02f, 0.03f};
    b.camera("overview", {0, 6, 14}, {0, 0, 0}, 60, 0.1, 100);

    b.add("ground", quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}),
          b.material("ground", {glm::vec3(0.5f), 0, 0.8f}));
    const Primitive ball = sphere(0.4, 32, 16);
    for (std::uint32_t k = 0; k < 400; ++k) {
        const std::uint32_t row = k / 20, column = k % 20;
        const glm::dvec3 random(u01(3 * k), u01(3 * k + 1), u01(3 * k + 2));
        const std::string name = fmt::format("sphere {}", k);
        const int material = b.material(name, {glm::vec3(0.2 + 0.7 * random), static_cast<float>(row & 1),
                                               static_cast<float>(0.1 + 0.9 * column / 19)});
        b.add(name, ball, material, glm::dvec3((column - 9.5) * 2, 0.5, (row - 9.5) * 2));
    }

    b.sun({-0.5, -1, -0.3}, glm::vec3(1), 1);
    b.scene.lights.reserve(b.scene.lights.size() + lights);
    for (std::uint32_t i = 0; i < lights; ++i) {
        const double radius = 20 * std::sqrt((i + 0.5) / lights),
                     theta = i * 2.399963229728653;  // golden angle
        const std::uint32_t c = 65536 + 3 * i;
        b.point(
            {radius * std::cos(theta), 1 + 0.5 * std::sin(static_cast<double>(i)), radius * std::sin(theta)},
            glm::vec3(0.3 + 0.7 * glm::dvec3(u01(c), u01(c + 1), u01(c + 2))), 4, 3);
    }
}

}  // namespace diptych::builtin
