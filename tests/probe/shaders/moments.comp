// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shadows/msm.glsl"
#include "tests/probe/shaders/probe.glsl"

// depths of two parts of a filter and of the receiver (1 towards the light), the first part's fraction;
// exponent, negative exponent, nearest depth, bleed, minimum variance, moment bias -> visibility, the four
// stored moments; for feature_shadows
const uint WIDTH = 10;

vec4 stored(const float depth, const ShadowLight light) {
    if (feature_shadows == SHADOWS_MSM4) return quantisedMoments(depth);
    return warpedMoments(depth, light.exponent, light.negative, light.nearest);
}

void main() {
    if (PROBE_ROW >= probe_rows) return;
    ShadowLight light;
    float fraction = IN(WIDTH, 3), receiver = IN(WIDTH, 2);
    light.exponent = IN(WIDTH, 4);
    light.negative = IN(WIDTH, 5);
    light.nearest = IN(WIDTH, 6);
    light.bleed = IN(WIDTH, 7);
    light.min_variance = IN(WIDTH, 8);
    light.moment_bias = IN(WIDTH, 9);
    // Weighted before adding, as a blur does: the sum of the largest moments overflows.
    vec4 moments = stored(IN(WIDTH, 0), light) * fraction + stored(IN(WIDTH, 1), light) * (1.0 - fraction);
    OUT(5, 0) = visibilityOfMoments(moments, receiver, light);
    OUT(5, 1) = moments.x;
    OUT(5, 2) = moments.y;
    OUT(5, 3) = moments.z;
    OUT(5, 4) = moments.w;
}
