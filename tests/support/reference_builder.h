// SPDX-License-Identifier: MIT
// Surfaces and lights for tests of the reference.
#pragma once

#include "compare/reference/light/lighting.h"
#include "compare/reference/reference.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/view.h"
#include "tests/support/light_formulas.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace diptych::reference {

constexpr double pi = std::numbers::pi;

// White, without a dielectric layer: radiance E / pi.
inline Surface lambertian(const glm::dvec3& normal = {0, 0, 1}, const glm::dvec3& position = {0, 0, 0}) {
    Surface s;
    s.position = position;
    s.normal = s.geometric_normal = s.to_viewer = glm::normalize(normal);
    s.albedo = glm::dvec3(1);
    s.dielectric_f90 = 0;
    return s;
}

// F = 1 everywhere: only the specular lobe, viewed at `angle` (radians) from the normal +Z.
inline Surface mirror(double roughness, double angle) {
    Surface s = lambertian();
    s.to_viewer = {std::sin(angle), 0, std::cos(angle)};
    s.metallic = 1;
    s.roughness = roughness;
    return s;
}

// A glossy dielectric of a third of white, likewise.
inline Surface lacquer(double angle) {
    Surface s = mirror(0.5, angle);
    s.metallic = 0;
    s.albedo = glm::dvec3(1.0 / 3);
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    return s;
}

// A unit vector by its angles from +Z and +X.
inline glm::dvec3 polar(double angle, double azimuth) {
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

inline Light lightOf(LightKind kind, const glm::dvec3& position, const glm::dvec3& direction = {0, 0, -1}) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.axis = anyAcross(light.direction);
    return light;
}

// Every light casts shadows.
inline std::vector<std::size_t> everyLight(std::span<const Light> lights) {
    std::vector<std::size_t> all(lights.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

inline Shading shadedBy(std::span<const Light> lights, const Surface& surface, const Visibility& open = {},
                        std::uint64_t seed = 1) {
    return Lighting({.lights = lights, .casters = everyLight(lights)})(surface, open, seed);
}
inline double reflectedBy(const Light& light, const Surface& surface) {
    const Shading shading = shadedBy(std::span(&light, 1), surface);
    EXPECT_LE(shading.uncertainty, 1e-6 * shading.reflected.size());
    return shading.reflected.diffuse.g + shading.reflected.specular.g;
}
inline double irradianceBy(const Light& light, const Surface& surface) {
    return reflectedBy(light, surface) * pi;
}

// Radiance 1 from everywhere.
inline const Environment& whiteSky() {
    static const Environment sky{"sky", Image(8, 4, 3, 1.0f)};
    return sky;
}
inline Shading underAmbient(const Surface& surface, Multiscatter multiscatter = Multiscatter::off) {
    return Lighting({.ambient = glm::dvec3(1), .multiscatter = multiscatter})(surface, {}, 1);
}
// With the costs of the sky's approximations.
inline Shading withCosts(const Environment& sky, const Surface& surface) {
    Lighting lighting({.environment = &sky});
    lighting.takeCosts();
    return lighting(surface, {}, 5);
}
// Every kind of light at once; the environment's costs and surroundings too.
inline Shading underAllLights(const Surface& surface) {
    Light point = lightOf(LightKind::point, {0.5, 0, 2}), rect = lightOf(LightKind::rect, {-1, 0, 1});
    rect.width = rect.height = 1;
    const std::vector<Light> lights{point, rect};
    Lighting lighting({.lights = lights, .environment = &whiteSky(), .ambient = glm::dvec3(0.5)});
    lighting.takeCosts();
    lighting.takeSurroundings();
    return lighting(
        surface, [](const glm::dvec3& l, double) { return l.x > 0; }, 7);
}

// The integral of f(u, v) over 0 to 1 in both, by Simpson's rule with even numbers of steps.
template <class F>
double simpson(int across, int up, const F& f) {
    const auto weight = [](int i, int steps) { return i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0; };
    double sum = 0;
    for (int i = 0; i <= across; ++i)
        for (int j = 0; j <= up; ++j)
            sum += weight(i, across) * weight(j, up) * f(double(i) / across, double(j) / up);
    return sum / (9.0 * across * up);
}

}  // namespace diptych::reference
