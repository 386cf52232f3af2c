// SPDX-License-Identifier: MIT
// KHR_lights_punctual.
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL

#include "shaders/lib/contract.glsl"

struct Incident {
    vec3 direction;   // unit, to the light
    vec3 irradiance;  // W/m^2 on a surface across the direction
};

Incident fromDirectionalLight(Light light) {
    return Incident(-light.direction, light.intensity);
}

// A point light or a spot (a point light's cone is 0 * cos + 1). The window
// max(1 - (d / range)^4, 0) is compared first, so that it is exactly zero from the range on.
Incident fromLocalLight(Light light, vec3 position) {
    vec3 to_light = light.position - position;
    float d2 = max(dot(to_light, to_light), MIN_LIGHT_DISTANCE_SQUARED);
    vec3 direction = to_light * inversesqrt(d2);  // zero, and no light, in the light's own centre
    float range2 = light.range * light.range;
    float x = d2 / range2;
    float window = d2 < range2 ? 1.0 - x * x : 0.0;
    float cone = clamp(light.cone_offset - dot(direction, light.direction) * light.cone_scale, 0.0, 1.0);
    return Incident(direction, light.intensity * (window * cone * cone / d2));
}

#endif
