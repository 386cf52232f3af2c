// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shadows/msm.glsl"
#include "tests/probe/shaders/probe.glsl"

// four stored moments, the receiver's depth; exponent, negative exponent, nearest depth, bleed, minimum
// variance, moment bias -> visibility; for feature_shadows
const uint WIDTH = 11;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    ShadowLight light;
    light.exponent = IN(WIDTH, 5);
    light.negative = IN(WIDTH, 6);
    light.nearest = IN(WIDTH, 7);
    light.bleed = IN(WIDTH, 8);
    light.min_variance = IN(WIDTH, 9);
    light.moment_bias = IN(WIDTH, 10);
    OUT(1, 0) = visibilityOfMoments(vec4(IN3(WIDTH, 0), IN(WIDTH, 3)), IN(WIDTH, 4), light);
}
