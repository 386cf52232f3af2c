// SPDX-License-Identifier: MIT
// What the kernels of posing begin with.
#ifndef POSING_THREAD_GLSL
#define POSING_THREAD_GLSL

#include "shaders/lib/posing.glsl"

layout(local_size_x = POSING_THREADS) in;
layout(push_constant, scalar) uniform PosingBlock { PosingConstants constants; };

// The number of this thread among those of all workgroups.
uint posingThread() {
    return (gl_WorkGroupID.y * POSING_GROUPS + gl_WorkGroupID.x) * POSING_THREADS + gl_LocalInvocationIndex;
}

#endif
