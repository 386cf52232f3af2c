// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/punctual_lights.glsl"
#include "tests/probe/shaders/probe.glsl"

// position of the light from the surface, 1 / range^2, direction, cone scale, cone offset -> irradiance,
// direction
void main() {
    if (PROBE_ROW >= probe_rows) return;
    Light light;
    light.position = IN3(9, 0);
    light.inverse_range_squared = IN(9, 3);
    light.intensity = vec3(1.0);
    SpotCone cone = SpotCone(IN3(9, 4), IN(9, 7), IN(9, 8), vec3(0.0));
    Incident incident = fromSpotLight(light, cone, vec3(0.0));
    OUT(4, 0) = incident.irradiance.r;
    for (uint i = 0; i < 3; ++i) OUT(4, 1 + i) = incident.direction[i];
}
