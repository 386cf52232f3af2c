// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(push_constant, scalar) uniform Constants { vec4 color; float depth, corner; };

// A triangle at one depth, which may be outside the clip volume. `corner`: 3 covers the image, 1 its upper
// left half.
void main() {
    gl_Position = vec4(gl_VertexIndex == 1 ? corner : -1.0, gl_VertexIndex == 2 ? corner : -1.0, depth, 1.0);
}
