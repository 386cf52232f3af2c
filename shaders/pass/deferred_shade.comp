// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// HALF: 0 to 1

// SAMPLES: 0 to 1
// As deferred_shade.frag; stores to every pixel, 0 where nothing was drawn; of several samples to those of
// the groups of samples that the dispatch shades alone.
#define TEXEL_VIEW
#include "shaders/lib/deferred_lighting.glsl"
#include "shaders/lib/shade.glsl"

void main() {
    if (!isInPicture()) return;
#if SAMPLES
    uint mask = groupHere().mask, i = 0u;  // of no sample where the pixel has no such group
    if (mask == 0u) return;
    vec4 texel = litHere();
    do {
        if ((mask >> i & 1u) != 0u) imageStore(lit_target, pixelHere(), int(i), texel);
    } while (++i < feature_samples);
#else
    vec4 texel = vec4(0.0);
    if (isDrawnHere()) texel = litHere();
    imageStore(lit_target, pixelHere(), texel);
#endif
}
