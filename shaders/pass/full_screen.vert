// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One triangle over the screen at the far end of the reversed depth, which the viewport puts just above 0: a
// depth test of LESS_OR_EQUAL passes where something was drawn, and skips the background before shading.
void main() {
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
