// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Output attachments: 1 to 8 images of channels.
#define FLAT_VIEW
#include "shaders/lib/surface/capture.glsl"
#include "shaders/lib/surface/deferred.glsl"

void main() {
    float z;
    Surface s = deferredSurface(z);
    capture(s, z, shadedSurfaces());
}
