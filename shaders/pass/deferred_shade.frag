// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define FLAT_VIEW
#include "shaders/lib/gbuffer_read.glsl"
#include "shaders/lib/shade.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    float z = depthAt(p);
    out_lit = vec4(lit(shade(surfaceFromGBuffer(p, z), lightsAt(gl_FragCoord.xy, z))), 1.0);
}
