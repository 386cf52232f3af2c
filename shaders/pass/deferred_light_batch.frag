// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define FLAT_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_layer;  // parts of layers that the scene has
layout(location = 3) out vec4 out_next_layer;

void main() {
    PartialSums sums = partialSumsHere();
    out_diffuse = sums.diffuse;
    out_specular = sums.specular;
    if (storesLayer(LAYER_CLEARCOAT)) {
        out_layer = sums.clearcoat;
        if (storesLayer(LAYER_SHEEN)) out_next_layer = sums.sheen;
    } else if (storesLayer(LAYER_SHEEN)) {
        out_layer = sums.sheen;
    }
}
