// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/slab.glsl"
#include "tests/probe/shaders/probe.glsl"

// v, n (unit), index, thickness, attenuation colour and distance -> fraction of light that crosses the slab,
// way to the exit
const uint WIDTH = 12;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s;
    vec3 v = IN3(WIDTH, 0);
    s.normal = IN3(WIDTH, 3);
    s.thickness = IN(WIDTH, 7);
    s.attenuation_color = IN3(WIDTH, 8);
    s.attenuation_distance = IN(WIDTH, 11);
    vec3 crossed = crossing(s), way = slabShift(s, v, IN(WIDTH, 6));
    for (uint c = 0; c < 3; ++c) {
        OUT(6, c) = crossed[c];
        OUT(6, 3 + c) = way[c];
    }
}
