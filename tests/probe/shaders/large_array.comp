// SPDX-License-Identifier: MIT
// A per-thread array that exceeds the registers, with dynamic indices: for compiler tests.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Input { uint values[]; } source;
layout(set = 0, binding = 1, std430) writeonly buffer Output { uint values[]; } made;
layout(push_constant) uniform Constants { uint rows; };

void main() {
    uint kept[2048];
    for (uint i = 0; i < 2048; ++i) kept[i] = source.values[i * rows];
    for (uint i = 0; i < rows; ++i) kept[source.values[i] % 2048] += i;
    made.values[gl_GlobalInvocationID.x] = kept[source.values[rows] % 2048];
}
