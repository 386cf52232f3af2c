// SPDX-License-Identifier: MIT
// Haze for tests: Settings, a sun, and the reference's Air for both.
#pragma once

#include "compare/reference/light/haze.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"

#include <glm/geometric.hpp>

namespace diptych {

inline Settings hazeSettings(float density = 1) {
    Settings settings;
    settings.haze = true;
    settings.haze_density = density;
    return settings;
}

// Directions are rounded to float32, as in shaders.
inline glm::dvec3 floatUnit(const glm::dvec3& v) {
    return glm::dvec3(glm::vec3(glm::normalize(v)));
}

inline Light sunTowards(const glm::dvec3& direction, float irradiance) {
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = floatUnit(direction);
    sun.color = {1, 0.75f, 0.5f};
    sun.intensity = irradiance;
    return sun;
}

// `sun` must outlive the result.
inline reference::Air airOfSettings(const Settings& s, const Light* sun) {
    const auto doubles = [&](const Rgb& c) {
        return glm::dvec3(double{c.r}, double{c.g}, double{c.b}) * double{s.haze_density};
    };
    reference::Air air;
    air.molecules = {doubles(s.haze_rayleigh), doubles(s.haze_rayleigh), double{s.haze_rayleigh_height}};
    air.aerosols = {doubles(s.haze_mie), doubles(s.haze_mie) / 0.9, double{s.haze_mie_height}};
    air.g = double{s.haze_g};
    air.ground = double{s.haze_ground};
    air.uniform = s.haze_march_steps == 0;
    air.sun = sun;
    air.ambient = {double{s.ambient.r}, double{s.ambient.g}, double{s.ambient.b}};
    return air;
}

}  // namespace diptych
