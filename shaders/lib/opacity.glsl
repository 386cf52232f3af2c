// SPDX-License-Identifier: MIT
// How much a blended surface covers of what is behind it, before anything is shaded.
#ifndef OPACITY_GLSL
#define OPACITY_GLSL

#include "shaders/lib/material.glsl"

// 0 to 1.
float opacityOf(vec4 base_color) { return clamp(base_color.a, 0.0, 1.0); }

#endif
