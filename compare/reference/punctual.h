// SPDX-License-Identifier: MIT
// Lights without extent: KHR_lights_punctual (Khronos 2019) as it is defined, in double.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// The factor that a light's range puts on it at a distance, both in metres: max(min(1 - (d / range)^4, 1),
// 0).
double rangeWindow(double distance, double range);

// A directional light without a disc, a point light or a spot, as one place sees it.
struct Incident {
    glm::dvec3 to_light{0};    // unit; 0 in the light's own place
    glm::dvec3 irradiance{0};  // W/m^2 on a surface across that direction
    double distance = 0;       // m; infinite for a directional light
};

// `place` and light.position in one space.
Incident incident(const Light& light, const glm::dvec3& light_position, const glm::dvec3& place);

}  // namespace diptych::reference
