// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// HALF: 0 to 1

// ATTACHMENTS: 1 to 8 channels.
// COVERAGE: 0 to 1
#include "shaders/lib/capture.glsl"
#include "shaders/lib/forward.glsl"

void main() {
    capture(forwardSurface(), shadedDepth(), 0u);
}
