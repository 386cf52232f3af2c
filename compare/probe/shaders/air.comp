// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/environment/air.glsl"
#include "compare/probe/shaders/rows.glsl"

// haze (20), direction, equivalent metres at height 0 -> transmittance, in-scattered radiance
void hazed() {
    Haze h = HAZE_OF_TEXELS(in4(0), in4(4), in4(8), in4(12), in4(16));
    Hazed hazed = hazeOfAir(h, in1(23), in3(20));
    out3(0, hazed.transmittance);
    out3(3, hazed.scattered);
}

void main() {
    if (beyondRows()) return;
    vec3 whole, less_one;
    switch (probed) {
        case 0:
            exponential(vec3(in1(0)), whole, less_one);
            out1(0, whole.x);
            out1(1, less_one.x);
            break;
        case 1: out1(0, airAlong(in1(0), in1(1), in1(2), in1(3))); break;
        case 2: out1(0, airBeyond(in1(0), in1(1), in1(2))); break;
        case 3: hazed(); break;
        case 4: out1(0, logRatio(in1(0))); break;
    }
}
