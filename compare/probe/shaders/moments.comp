// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shadows/msm.glsl"
#include "compare/probe/shaders/rows.glsl"

// exponent, the other warp's, nearest depth, bleed, smallest variance, moment bias
ShadowLight lightAt(const uint i) {
    ShadowLight light;
    light.exponent = in1(i);
    light.negative = in1(i + 1);
    light.nearest = in1(i + 2);
    light.bleed = in1(i + 3);
    light.min_variance = in1(i + 4);
    light.moment_bias = in1(i + 5);
    return light;
}

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0: {  // the light, depth -> four moments
            ShadowLight light = lightAt(0);
            out4(0, warpedMoments(in1(6), light.exponent, light.negative, light.nearest));
            break;
        }
        case 1: out1(0, chebyshev(in1(0), in1(1))); break;
        case 2: out4(0, momentsOfQuantised(quantisedMoments(in1(0)))); break;
        case 3:  // the light, moments, depth -> visibility
            out1(0, visibilityOfMoments(in4(6), in1(10), lightAt(0)));
            break;
        case 4: out1(0, min4MomentShadow(in4(0), in1(4), in1(5))); break;
    }
}
