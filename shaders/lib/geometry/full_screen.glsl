// SPDX-License-Identifier: MIT
// Full-screen triangle at the far end of reversed depth, which the viewport maps to just above 0. A
// LESS_OR_EQUAL depth test then passes where geometry was rendered and skips the background before
// shading.
#ifndef FULL_SCREEN_GLSL
#define FULL_SCREEN_GLSL

vec4 fullScreenCorner(const int vertex) {
    return vec4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? 3.0 : -1.0, 0.0, 1.0);
}

#endif
