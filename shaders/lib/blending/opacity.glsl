// SPDX-License-Identifier: MIT
// Opacity of a blended surface, computed before shading.
#ifndef OPACITY_GLSL
#define OPACITY_GLSL

#include "shaders/lib/surface/material.glsl"

// Fraction of the light behind it that it hides, 0 to 1. A surface without coverage adds no light.
float opacityOf(const vec4 base_color) { return clamp(base_color.a, 0.0, 1.0); }

#endif
