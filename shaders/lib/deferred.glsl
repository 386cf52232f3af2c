// SPDX-License-Identifier: MIT
// The Surface that deferred lighting shades at a fragment. With several samples a pixel (SAMPLES) a draw
// shades one group of samples of each pixel, its number in the push constants, and covers these samples
// alone: SET_GBUFFER's depth is then the image of groups, which the draw is tested against.
#ifndef DEFERRED_GLSL
#define DEFERRED_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/gbuffer_read.glsl"
#if SAMPLES
#include "shaders/lib/sample_groups.glsl"

// A mask that a shader writes must not put the test off until it has run.
layout(early_fragment_tests) in;
#endif

// Surfaces that are shaded at the fragment's pixel.
uint shadedSurfaces() {
#if SAMPLES
    return groupsOf(depthAt(ivec2(gl_FragCoord.xy)));
#else
    return 1u;
#endif
}

Surface deferredSurface(out float z) {
    ivec2 p = ivec2(gl_FragCoord.xy);
    int shaded = 0;
#if SAMPLES
    SampleGroup group = sampleGroup(depthAt(p), constants.group);
    gl_SampleMask[0] = int(group.mask);
    shaded = group.first;
#endif
    return surfaceFromGBuffer(p, shaded, z);
}

#endif
