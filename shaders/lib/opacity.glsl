// SPDX-License-Identifier: MIT
// How much a blended surface covers of what is behind it, before anything is shaded.
#ifndef OPACITY_GLSL
#define OPACITY_GLSL

#include "shaders/lib/material.glsl"
#include "shaders/lib/transmission.glsl"

// The share of its place that it covers, 0 to 1. What covers nothing sends nothing.
float coverageOf(vec4 base_color) {
    return feature_transmission == TRANSMISSION_WHOLE ? 1.0 : clamp(base_color.a, 0.0, 1.0);
}

// What it hides of what is behind it, 0 to 1.
float opacityOf(Surface s, vec4 base_color) {
    float covers = coverageOf(base_color);
    if (on(feature_transmission)) covers *= 1.0 - transmittedShare(s);
    return covers;
}

#endif
