// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/ltc.glsl"
#include "compare/probe/shaders/rows.glsl"

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0:  // cosine, sine -> angle, angle / sine
            out1(0, angleOf(in1(0), in1(1)));
            out1(1, angleRatio(in1(0), in1(1)));
            break;
        case 1: out3(0, edgeFactor(in3(0), in3(3))); break;  // two directions
        case 2:  // M^-1, centre, both half-side vectors -> form factor
            out3(0, parallelogramFactor(Ltc(in1(0), in1(1), in1(2)), in3(3), in3(6), in3(9)));
            break;
    }
}
