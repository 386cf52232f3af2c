// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/gbuffer_read.glsl"
#include "shaders/lib/shade.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    out_lit = vec4(lit(shade(surfaceFromGBuffer(p, depthAt(p)))), 1.0);
}
