// SPDX-License-Identifier: MIT
// The outputs of a capture pass: one channel an attachment; which one is a specialization constant, so a
// capture that asks for no light does no lighting.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#include "shaders/lib/debug.glsl"

layout(location = 0) out vec4 out_0;
layout(location = 1) out vec4 out_1;
layout(location = 2) out vec4 out_2;
layout(location = 3) out vec4 out_3;
layout(location = 4) out vec4 out_4;
layout(location = 5) out vec4 out_5;
layout(location = 6) out vec4 out_6;
layout(location = 7) out vec4 out_7;

void capture(Surface s, Radiance radiance, float z) {
    out_0 = debugValue(feature_capture_0, s, radiance, z);
    out_1 = debugValue(feature_capture_1, s, radiance, z);
    out_2 = debugValue(feature_capture_2, s, radiance, z);
    out_3 = debugValue(feature_capture_3, s, radiance, z);
    out_4 = debugValue(feature_capture_4, s, radiance, z);
    out_5 = debugValue(feature_capture_5, s, radiance, z);
    out_6 = debugValue(feature_capture_6, s, radiance, z);
    out_7 = debugValue(feature_capture_7, s, radiance, z);
}

#endif
