// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// ATTACHMENTS: 1 to 8 channels.
#define FLAT_VIEW
#include "shaders/lib/capture.glsl"
#include "shaders/lib/gbuffer_read.glsl"

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    float z = depthAt(p);
    capture(surfaceFromGBuffer(p, z), z);
}
