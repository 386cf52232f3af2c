// SPDX-License-Identifier: MIT
// One triangle over the screen at the far end of the reversed depth, which the viewport puts just above 0: a
// depth test of LESS_OR_EQUAL passes where something was drawn, and skips the background before shading.
#ifndef FULL_SCREEN_GLSL
#define FULL_SCREEN_GLSL

vec4 fullScreenCorner(int vertex) { return vec4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? 3.0 : -1.0, 0.0, 1.0); }

#endif
