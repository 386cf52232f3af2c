// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/brdf.glsl"
#include "tests/probe/shaders/probe.glsl"

// alpha, n, h -> D
void main() {
    if (PROBE_ROW >= probe_rows) return;
    OUT(1, 0) = distributionGgx(IN(7, 0), IN3(7, 1), IN3(7, 4));
}
