// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// One triangle, with one value at each corner.
layout(push_constant, scalar) uniform Constants { vec4 corners[3]; vec3 values; uint kept; };
layout(location = 0) out float v_value;

void main() {
    gl_Position = vec4(corners[gl_VertexIndex].xyz, 1.0);
    v_value = values[gl_VertexIndex];
}
