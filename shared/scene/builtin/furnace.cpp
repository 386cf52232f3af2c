// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace diptych::builtin {

// The white furnace test of Heitz et al., approximated with directional lights: all surfaces are white and
// lit equally from all sides. If an environment of radiance 1 replaces the lights, objects whose BRDF
// loses no energy vanish against the background of radiance 1.
void furnace(Builder& b) {
    b.scene.background = glm::vec3(1);
    b.camera("front", {0, 0, 9}, {0, 0, 0}, 30, 0.1, 100);
    constexpr int COLUMNS = 11;
    const Primitive ball = sphere(0.42, 64, 32);
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < COLUMNS; ++column) {
            const float metallic = row == 0 ? 0.0f : 1.0f,
                        roughness = static_cast<float>(column) / (COLUMNS - 1);
            const std::string name = fmt::format("{} {:.1f}", row == 0 ? "dielectric" : "metal", roughness);
            b.add(name, ball, b.material(name, {glm::vec3(1), metallic, roughness}),
                  glm::dvec3(0.7 * (column - 5), row == 0 ? -0.55 : 0.55, 0));
        }

    // Suns on a spherical Fibonacci lattice, each of solid angle 4 pi / N. Source: Gonzalez 2010,
    // "Measurement of Areas on a Sphere Using Fibonacci and Latitude-Longitude Lattices". Each replaces
    // radiance 1 over its solid angle, so it has 4 pi / N lux. A plane then receives about pi lux, and a
    // white Lambertian surface has radiance 1.
    constexpr int SUNS = 64;
    for (int i = 0; i < SUNS; ++i) {
        const double y = 1 - (2 * i + 1.0) / SUNS, r = std::sqrt(1 - y * y), theta = i * 2.399963229728653;
        b.sun({r * std::cos(theta), y, r * std::sin(theta)}, glm::vec3(1),
              static_cast<float>(4 * std::numbers::pi / SUNS));
    }
}

}  // namespace diptych::builtin
