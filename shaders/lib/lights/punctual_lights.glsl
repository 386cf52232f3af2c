// SPDX-License-Identifier: MIT
// KHR_lights_punctual.
#ifndef PUNCTUAL_LIGHTS_GLSL
#define PUNCTUAL_LIGHTS_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/lights/incident.glsl"

Incident fromDirectionalLight(const Light light) {
    return Incident(light.position, light.intensity);
}

// The window max(1 - (d / range)^4, 0), or its square, as a function of d^2. The comparison makes it
// exactly 0 beyond the range. A light out of range thus adds nothing, not even rounding, if it is
// evaluated.
float rangeWindow(const Light light, const float d2) {
    float x = d2 * light.inverse_range_squared;
    float window = x < 1.0 ? 1.0 - x * x : 0.0;
    if (on(feature_squared_window)) window *= window;
    return window;
}

Incident fromPointLight(const Light light, const vec3 position) {
    vec3 to_light = light.position - position;
    float d2 = max(dot(to_light, to_light), MIN_LIGHT_DISTANCE_SQUARED);
    float window = rangeWindow(light, d2);
    float inverse = inversesqrt(d2);
    // At the light's own position the direction is 0, so no light arrives.
    return Incident(to_light * inverse, light.intensity * (window * (inverse * inverse)));
}

Incident fromSpotLight(const Light light, const SpotCone cone, const vec3 position) {
    Incident incident = fromPointLight(light, position);
    float c = clamp(cone.offset - dot(incident.direction, cone.direction) * cone.scale, 0.0, 1.0);
    float fraction = c * c;
    if (on(feature_smooth_cones)) fraction *= 3.0 - 2.0 * c;
    incident.irradiance *= fraction;
    return incident;
}

#endif
