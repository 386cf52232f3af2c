// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Output attachments: 1 to 8 images of channels.
#include "shaders/lib/surface/capture.glsl"
#include "shaders/lib/surface/forward.glsl"

void main() {
    capture(forwardSurface(), shadedDepth(), 0u);
}
