// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/brdf.glsl"
#include "tests/probe/shaders/probe.glsl"

// alpha, n, h -> D
void main() {
    if (PROBE_ROW >= probe_rows) return;
    float alpha = IN(7, 0);
    vec3 n = IN3(7, 1), h = IN3(7, 4);
    float k = alpha * dot(h, h) / ggxDenominator(alpha * alpha, n, h);
    OUT(1, 0) = k * k * INVERSE_PI;
}
