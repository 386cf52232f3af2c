// SPDX-License-Identifier: MIT
// Opacity of a blended surface, computed before shading.
#ifndef OPACITY_GLSL
#define OPACITY_GLSL

#include "shaders/lib/surface/material.glsl"
#include "shaders/lib/blending/transmission.glsl"

// Coverage, 0 to 1. A surface without coverage adds no light.
float coverageOf(vec4 base_color) {
    return feature_transmission == TRANSMISSION_WHOLE ? 1.0 : clamp(base_color.a, 0.0, 1.0);
}

// Fraction of the light behind it that it hides, 0 to 1.
float opacityOf(Surface s, vec4 base_color) {
    float covers = coverageOf(base_color);
    if (on(feature_transmission)) covers *= 1.0 - transmittedShare(s);
    return covers;
}

#endif
