// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/brdf.glsl"
#include "compare/probe/shaders/rows.glsl"

// alpha, n, s -> D
void distribution() {
    float alpha = in1(0);
    vec3 n = in3(1), s = in3(4);
    float k = alpha * dot(s, s) / ggxDenominator(alpha * alpha, n, s);
    out1(0, k * k * INVERSE_PI);
}

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0: distribution(); break;
    }
}
