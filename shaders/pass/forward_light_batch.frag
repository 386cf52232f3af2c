// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/lights/partial_outputs.glsl"

void main() { writeSums(shade(forwardSurface(), lightsAt(gl_FragCoord.xy, shadedDepth()))); }
