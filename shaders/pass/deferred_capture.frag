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
    Surface s = surfaceFromGBuffer(p, z);
    PixelLights lights = lightsAt(gl_FragCoord.xy, z);
    capture(s, lights, shade(s, lights), z);
}
