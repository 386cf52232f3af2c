// SPDX-License-Identifier: MIT
// Reads and writes rows of floats as bits; see compare/probe/device_rows.h.
#ifndef ROWS_GLSL
#define ROWS_GLSL

#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer RowsIn { uint row_in[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer RowsOut { uint row_out[]; };
layout(push_constant, scalar) uniform Rows { uint rows, ins, outs; };

// Index of the function: one pipeline each. The constant's id is above those of all features.
layout(constant_id = 1000) const uint probed = 0;

bool beyondRows() { return gl_GlobalInvocationID.x >= rows; }

uint inBits(const uint i) { return row_in[gl_GlobalInvocationID.x * ins + i]; }
float in1(const uint i) { return uintBitsToFloat(inBits(i)); }
vec3 in3(const uint i) { return vec3(in1(i), in1(i + 1), in1(i + 2)); }
vec4 in4(const uint i) { return vec4(in3(i), in1(i + 3)); }

void outBits(const uint i, const uint bits) { row_out[gl_GlobalInvocationID.x * outs + i] = bits; }
void out1(const uint i, const float value) { outBits(i, floatBitsToUint(value)); }
void out3(const uint i, const vec3 value) {
    out1(i, value.x);
    out1(i + 1, value.y);
    out1(i + 2, value.z);
}
void out4(const uint i, const vec4 value) {
    out3(i, value.xyz);
    out1(i + 3, value.w);
}

#endif
