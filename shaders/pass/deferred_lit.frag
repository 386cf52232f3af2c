// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Draws the image that deferred_shade.comp has stored, bound as the first partial sum, to smaller formats.
// Devices round attachment writes and shader stores differently.
#define FLAT_VIEW
#include "shaders/lib/lights/partial_sums.glsl"

layout(location = 0) out vec4 out_lit;

void main() { out_lit = partialDiffuse(); }
