// SPDX-License-Identifier: MIT
// Punctual lights as KHR_lights_punctual (Khronos 2019) defines them, in double.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// Attenuation by a light's range; distances in metres: max(min(1 - (d / range)^4, 1), 0), or its square.
double rangeWindow(double distance, double range, RangeWindow window = RangeWindow::gltf);

struct Falloff {
    RangeWindow window = RangeWindow::gltf;
    SpotFalloff cone = SpotFalloff::gltf;
};

// The light that arrives at a point from a directional light without a disc, a point light or a spot
// light.
struct Incident {
    glm::dvec3 to_light{0};    // unit; 0 at the light's own position
    glm::dvec3 irradiance{0};  // W/m^2 on a surface perpendicular to that direction
    double distance = 0;       // m; infinite for a directional light
    // Errors of a path's float32: the angle by which `to_light` turns, rad; of `irradiance`, relative.
    double angle_error = 0, rounding = 0;
};

// `light_position` and `position` are relative to the eye, as a path rounds them.
Incident incident(const Light& light, const glm::dvec3& light_position, const glm::dvec3& position,
                  const Falloff& falloff = {});

}  // namespace diptych::reference
