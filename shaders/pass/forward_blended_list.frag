// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Stores the fragment at its key's index in the pixel's list, or adds it to the overflow sums.
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/blending/blended.glsl"
#include "shaders/lib/blending/fragment_list.glsl"
#include "shaders/lib/blending/optical_depth.glsl"

layout(early_fragment_tests) in;

void main() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    BlendedFragment f = blendedFragment();
    if (!isListed(p) || f.opacity == 0.0) return;
    uint pixel = listedPixel(p);
    uint index =
        indexOfFragment(pixel, fragmentKey(middleDepth(), constants.triangle + uint(gl_PrimitiveID)));
    if (index < list_of.layers) {
        fragments[index * listedPixels() + pixel] = vec4(f.radiance, f.opacity);
        return;
    }
    addToSum(pixel, 0, f.radiance.r);
    addToSum(pixel, 1, f.radiance.g);
    addToSum(pixel, 2, f.radiance.b);
    addToSum(pixel, 3, f.opacity);
    addToSum(pixel, 4, opticalDepth(f.opacity, MAX_OPTICAL_DEPTH));
    atomicAdd(fragment_keys[counter(0)], uint64_t(1));
}
