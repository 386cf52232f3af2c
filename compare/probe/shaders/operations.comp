// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "compare/probe/shaders/rows.glsl"

// The operations that all other functions use.
void main() {
    if (beyondRows()) return;
    float a = in1(0), b = ins > 1 ? in1(1) : 0.0, c = ins > 2 ? in1(2) : 0.0;
    switch (probed) {
        case 0: out1(0, a / b); break;
        case 1: out1(0, inversesqrt(a)); break;
        case 2: out1(0, sqrt(a)); break;
        case 3: out1(0, exp2(a)); break;
        case 4: out1(0, exp(a)); break;
        case 5: out1(0, log2(a)); break;
        case 6: out1(0, log(a)); break;
        case 7: out1(0, sin(a)); break;
        case 8: out1(0, cos(a)); break;
        case 9: out1(0, a + b); break;
        case 10: out1(0, a * b); break;
        case 11: out1(0, fma(a, b, c)); break;
        case 12: out1(0, unpackHalf2x16(packHalf2x16(vec2(a, 0.0))).x); break;
        case 13: out1(0, floor(a)); break;
        case 14: out1(0, float(inBits(0))); break;
        case 16: out1(0, dot(in3(0), in3(3))); break;
    }
}
