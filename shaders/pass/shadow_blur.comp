// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Gaussian blur of a layer of moments over feature_shadow_kernel texels, horizontally or vertically,
// clamped to the map's edge. One thread blurs BLUR_RUN texels, to reuse its reads. Weights are normalized
// before the sum, because a sum of moments may exceed the range of float32.
#include "shaders/lib/contract.glsl"

layout(local_size_x = MOMENT_THREADS) in;
layout(push_constant, scalar) uniform MomentBlock { MomentConstants constants; };
layout(set = SET_MOMENTS, binding = BINDING_MOMENT_SOURCE) uniform sampler2DArray source;
layout(set = SET_MOMENTS, binding = BINDING_MOMENT_TARGET) uniform writeonly image2DArray target;

const int RADIUS = int(feature_shadow_kernel / 2u), MAX_RADIUS = 3;  // texels on each side of the centre

// Half the side is two standard deviations, slightly more for narrow kernels.
float gaussian(const int k) {
    float x = float(k) / (0.15 * float(feature_shadow_kernel) + 0.35);
    return exp(-0.5 * x * x);
}

vec4 momentsAt(const ivec2 p) {
    vec4 moments = texelFetch(source, ivec3(p, 0), 0);
    return feature_shadows == SHADOWS_EVSM ? vec4(moments.xy, 0.0, 0.0) : moments;
}

void main() {
    const int run = int(BLUR_RUN);
    ivec2 along = constants.down != 0u ? ivec2(0, 1) : ivec2(1, 0);
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * (along * (run - 1) + 1), last = ivec2(constants.size) - 1;
    if (any(greaterThan(first, last))) return;
    float weights = 1.0;
    for (int k = 1; k <= RADIUS; ++k) weights += 2.0 * gaussian(k);
    vec4 read[BLUR_RUN + 2 * MAX_RADIUS];
    for (int i = 0; i < run + 2 * RADIUS; ++i)
        read[i] = momentsAt(clamp(first + along * (i - RADIUS), ivec2(0), last));
    for (int i = 0; i < run; ++i) {
        vec4 sum = read[i + RADIUS] / weights;
        for (int k = 1; k <= RADIUS; ++k) {
            float weight = gaussian(k) / weights;
            sum += weight * read[i + RADIUS - k] + weight * read[i + RADIUS + k];
        }
        ivec2 p = first + along * i;
        if (all(lessThanEqual(p, last))) imageStore(target, ivec3(p, 0), sum);
    }
}
