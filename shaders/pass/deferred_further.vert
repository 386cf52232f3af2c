// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Two triangles that cover the rows of listed sample groups in draw constants.group.
#define FLAT_VIEW
#include "shaders/lib/samples/further_groups.glsl"
#include "shaders/lib/geometry/view.glsl"

void main() {
    bool right = gl_VertexIndex == 1 || gl_VertexIndex >= 4;
    bool below = gl_VertexIndex == 2 || gl_VertexIndex == 3 || gl_VertexIndex == 5;
    float rows = rowsOf(imageLoad(further_count, ivec2(0)).r, constants.group);
    gl_Position = vec4(right ? 1.0 : -1.0, below ? 2.0 * rows - 1.0 : -1.0, 0.0, 1.0);
    passViewThrough();
}
