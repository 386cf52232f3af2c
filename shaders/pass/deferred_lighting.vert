// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The full-screen triangle of deferred lighting.
#define FLAT_VIEW
#include "shaders/lib/view.glsl"
#include "shaders/lib/full_screen.glsl"

void main() {
    gl_Position = fullScreenCorner(gl_VertexIndex);
    passViewThrough();
}
