// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define FLAT_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_lit;

void main() { out_lit = litHere(); }
