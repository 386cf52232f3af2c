// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define FLAT_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/lights/partial_outputs.glsl"

void main() { writeSums(partialSumsHere()); }
