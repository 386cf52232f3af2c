// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights.glsl"
#include "tests/probe/shaders/probe.glsl"

// position of the light from the surface, range, direction, cone scale, cone offset -> irradiance, direction
void main() {
    if (PROBE_ROW >= probe_rows) return;
    Light light;
    light.position = IN3(9, 0);
    light.range = IN(9, 3);
    light.intensity = vec3(1.0);
    light.direction = IN3(9, 4);
    light.cone_scale = IN(9, 7);
    light.cone_offset = IN(9, 8);
    Incident incident = fromLocalLight(light, vec3(0.0));
    OUT(4, 0) = incident.irradiance.r;
    for (uint i = 0; i < 3; ++i) OUT(4, 1 + i) = incident.direction[i];
}
