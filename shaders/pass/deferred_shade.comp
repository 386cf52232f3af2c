// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// As deferred_shade.frag; stores to every pixel, 0 where nothing was drawn; of several samples to those of
// the groups of samples that the dispatch shades alone.
#define TEXEL_VIEW
#include "shaders/lib/deferred_lighting.glsl"
#include "shaders/lib/shade.glsl"

void main() {
    if (!isInPicture()) return;
    uint mask = 0u;  // of no sample where the pixel has no such group
    if (multisampled()) mask = groupHere().mask;
    if (multisampled() && mask == 0u) return;
    vec4 texel = vec4(0.0);
    if (multisampled() || isDrawnHere()) texel = litHere();  // once in the module
    if (!multisampled()) {
        imageStore(lit_target, pixelHere(), texel);
        return;
    }
    uint i = 0u;
    do {
        if ((mask >> i & 1u) != 0u) imageStore(lit_samples, pixelHere(), int(i), texel);
    } while (++i < feature_samples);
}
