// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/punctual_lights.glsl"
#include "compare/probe/shaders/rows.glsl"

// light's position from the surface, 1 / range^2; cone: direction, scale, offset -> irradiance, direction
void main() {
    if (beyondRows()) return;
    Light light;
    light.position = in3(0);
    light.inverse_range_squared = in1(3);
    light.intensity = vec3(1.0);
    Incident incident = fromPointLight(light, vec3(0.0));
    if (probed == 1) incident = fromSpotLight(light, SpotCone(in3(4), in1(7), in1(8), vec3(0.0)), vec3(0.0));
    out1(0, incident.irradiance.r);
    if (outs > 1) out3(1, incident.direction);
}
