// SPDX-License-Identifier: MIT
// The outputs of a capture pass: one channel an attachment; which one is a specialization constant, so a
// capture of channels without light does no lighting. ATTACHMENTS is how many there are.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#include "shaders/lib/debug.glsl"

layout(location = 0) out vec4 out_channels[ATTACHMENTS];

uint captureMode(uint attachment) {
    uint modes[CAPTURE_ATTACHMENTS] =
        uint[](feature_capture_0, feature_capture_1, feature_capture_2, feature_capture_3, feature_capture_4,
               feature_capture_5, feature_capture_6, feature_capture_7);
    return modes[attachment];
}

void capture(Surface s, PixelLights lights, Radiance radiance, float z) {
    for (uint i = 0; i < ATTACHMENTS; ++i)
        out_channels[i] = debugValue(captureMode(i), s, lights, radiance, z);
}

#endif
