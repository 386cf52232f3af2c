// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_lit;

void main() { out_lit = vec4(lit(shade(forwardSurface(), lightsAt(gl_FragCoord.xy, shadedDepth()))), 1.0); }
