// SPDX-License-Identifier: MIT
// One triangle over the screen at the far end of the reversed depth, which the viewport maps to just above 0.
// A depth test of LESS_OR_EQUAL then passes where something was drawn, and the background is skipped before
// it is shaded.
#ifndef FULL_SCREEN_GLSL
#define FULL_SCREEN_GLSL

vec4 fullScreenCorner(int vertex) {
    return vec4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? 3.0 : -1.0, 0.0, 1.0);
}

#endif
