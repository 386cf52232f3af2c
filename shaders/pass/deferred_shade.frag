// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// HALF: 0 to 1

// SAMPLES: 0 to 1
#define FLAT_VIEW
#include "shaders/lib/deferred_lighting.glsl"
#include "shaders/lib/shade.glsl"

layout(location = 0) out vec4 out_lit;

void main() { out_lit = litHere(); }
