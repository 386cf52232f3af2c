// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Finds the nearest fragments of each pixel.
#include "shaders/lib/blending/fragment_list.glsl"
#include "shaders/lib/blending/opacity.glsl"

layout(early_fragment_tests) in;

void main() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    vec4 base_color = baseColor();
    cutOut(base_color);
    // Invisible fragments take no list entry.
    if (opacityOf(base_color) == 0.0 || !isListed(p)) return;
    insertKey(listedPixel(p), fragmentKey(middleDepth(), constants.triangle + uint(gl_PrimitiveID)));
}
