// SPDX-License-Identifier: MIT
// Lights and an object for tests of per-object lights, and the irradiance of their harmonics.
#pragma once

#include "shared/light/per_object.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace diptych {

inline constexpr double pi = std::numbers::pi;

inline Light point(const glm::dvec3& position, float candela,
                   float range = std::numeric_limits<float>::infinity()) {
    Light light;
    light.position = position;
    light.intensity = candela;
    light.range = range;
    return light;
}

inline Light sun(float lux) {
    Light light;
    light.kind = LightKind::directional;
    light.intensity = lux;
    return light;
}

inline GpuLights fromEye(const std::vector<Light>& lights, const LightFalloff& falloff = {}) {
    GpuLights result = gpuLights(lights, {0, 0, 0});
    result.falloff = falloff;
    return result;
}

// Every choice of --range-window and --spot-cone.
inline constexpr LightFalloff falloffs[] = {{false, false}, {false, true}, {true, false}, {true, true}};

inline const ObjectPosition unitBox{{0, 0, 0}, {0.5, 0.5, 0.5}};

// Irradiance at normal `n` from an object's spherical harmonics: all colours, and green alone.
inline glm::dvec3 evaluatedRgb(const gpu::ObjectIrradiance& e, const glm::dvec3& n) {
    const auto d = [](const gpu::vec3& v) { return glm::dvec3(v); };
    return d(e.constant) + d(e.linear_x) * n.x + d(e.linear_y) * n.y + d(e.linear_z) * n.z +
           d(e.xx) * (n.x * n.x - n.z * n.z) + d(e.yy) * (n.y * n.y - n.z * n.z) +
           2.0 * (d(e.xy) * n.x * n.y + d(e.yz) * n.y * n.z + d(e.xz) * n.x * n.z);
}
inline double evaluated(const gpu::ObjectIrradiance& e, const glm::dvec3& n) {
    return evaluatedRgb(e, n).g;
}

}  // namespace diptych
