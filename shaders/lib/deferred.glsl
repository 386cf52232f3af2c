// SPDX-License-Identifier: MIT
// The Surface that deferred lighting shades at a pixel. With several samples a pixel a draw or
// dispatch shades one group of samples of each pixel, its number in the push constants, and covers these
// samples alone: SET_GBUFFER's depth is then the image of groups, which a draw is tested against.
#ifndef DEFERRED_GLSL
#define DEFERRED_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/gbuffer_read.glsl"
#include "shaders/lib/pixel.glsl"
#include "shaders/lib/sample_groups.glsl"

#ifdef STAGE_frag
// A mask that a shader writes must not put the test off until it has run.
layout(early_fragment_tests) in;
#endif

SampleGroup groupHere() { return sampleGroup(depthAt(pixelHere()), constants.group); }

// Surfaces that are shaded at the pixel.
uint shadedSurfaces() { return multisampled() ? groupsOf(depthAt(pixelHere())) : 1u; }

// Of pixels of one sample.
bool isDrawnHere() { return depthAt(pixelHere()) > 0.0; }

Surface deferredSurface(out float z) {
    int shaded = 0;
    if (multisampled()) {
        SampleGroup group = groupHere();
#ifdef STAGE_frag
        gl_SampleMask[0] = int(group.mask);
#endif
        shaded = group.first;
    }
    return surfaceFromGBuffer(pixelHere(), shaded, z);
}

#endif
