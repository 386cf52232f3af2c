// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Converts a layer of depth to moments, one thread per texel.
#include "shaders/lib/shadows/msm.glsl"

layout(local_size_x = MOMENT_THREADS) in;
layout(push_constant, scalar) uniform MomentBlock { MomentConstants constants; };
layout(set = SET_MOMENTS, binding = BINDING_MOMENT_SOURCE) uniform sampler2DArray source;
layout(set = SET_MOMENTS, binding = BINDING_MOMENT_TARGET) uniform writeonly image2DArray target;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= int(constants.size)) return;
    float depth = texelFetch(source, ivec3(p, 0), 0).r;
    vec4 moments;
    if (feature_shadows == SHADOWS_MSM4)
        moments = quantisedMoments(depth);
    else
        moments = warpedMoments(depth, constants.exponent, constants.negative, constants.nearest);
    imageStore(target, ivec3(p, 0), moments);
}
