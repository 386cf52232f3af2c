// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/octahedral.glsl"
#include "tests/probe/shaders/probe.glsl"

// unit vector, bits -> decoded vector
void main() {
    if (PROBE_ROW >= probe_rows) return;
    uint bits = uint(IN(4, 3));
    vec3 n = decodeOctahedral(encodeOctahedral(IN3(4, 0), bits), bits);
    for (uint i = 0; i < 3; ++i) OUT(3, i) = n[i];
}
