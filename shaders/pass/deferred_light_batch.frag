// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define FLAT_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_clearcoat;  // only if the scene has clear coats

void main() {
    PartialSums sums = partialSumsHere();
    out_diffuse = sums.diffuse;
    out_specular = sums.specular;
    if (storesLayer(LAYER_CLEARCOAT)) out_clearcoat = sums.clearcoat;
}
