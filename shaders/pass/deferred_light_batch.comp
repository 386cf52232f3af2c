// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// As deferred_light_batch.frag; stores nothing at pixels without geometry.
#define TEXEL_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(set = SET_GBUFFER, binding = BINDING_SPECULAR_TARGET, rgba32f)
writeonly uniform image2D specular_target;

void main() {
    if (!isInImage() || !isDrawnHere()) return;
    Radiance sums = partialSumsHere();
    imageStore(lit_target, pixelHere(), vec4(sums.diffuse, sums.local_seen));
    imageStore(specular_target, pixelHere(), vec4(sums.specular, sums.local_light));
}
