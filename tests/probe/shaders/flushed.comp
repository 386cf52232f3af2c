// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/math/flushed.glsl"
#include "tests/probe/shaders/probe.glsl"

void main() {
    if (PROBE_ROW >= probe_rows) return;
    vec3 v = flushed(IN3(3, 0));
    for (uint i = 0; i < 3; ++i) OUT(3, i) = v[i];
}
