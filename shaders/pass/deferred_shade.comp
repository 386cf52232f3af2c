// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// As deferred_shade.frag. Stores every pixel, 0 without geometry. With MSAA it stores only the samples of
// the dispatch's sample group.
#define TEXEL_VIEW
#include "shaders/lib/shading/deferred_lighting.glsl"
#include "shaders/lib/shading/shade.glsl"

void main() {
    if (!isInImage()) return;
    uint mask = 0u;  // 0 if the pixel has no such group
    if (multisampled()) mask = groupHere().mask;
    if (multisampled() && mask == 0u) return;
    vec4 texel = vec4(0.0);
    if (multisampled() || isDrawnHere()) texel = litHere();  // one call, to inline the code once
    if (!multisampled()) {
        imageStore(lit_target, pixelHere(), texel);
        return;
    }
    uint i = 0u;
    do {
        if ((mask >> i & 1u) != 0u) imageStore(lit_samples, pixelHere(), int(i), texel);
    } while (++i < feature_samples);
}
