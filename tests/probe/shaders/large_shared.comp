// SPDX-License-Identifier: MIT
// 128 KiB of shared memory, more than our devices have: for compiler tests.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Input { uint values[]; } source;
layout(set = 0, binding = 1, std430) writeonly buffer Output { uint values[]; } made;
layout(push_constant) uniform Constants { uint rows; };
shared uint kept[32768];

void main() {
    for (uint i = gl_LocalInvocationIndex; i < 32768; i += 64) kept[i] = source.values[i];
    barrier();
    made.values[gl_GlobalInvocationID.x] = kept[source.values[rows] % 32768];
}
