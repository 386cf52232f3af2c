// SPDX-License-Identifier: MIT
// The Surface that deferred lighting shades at a pixel. Under MSAA, each draw or dispatch shades one
// sample group per pixel and writes only its samples; the group's index is a push constant. SET_GBUFFER's
// depth is then the sample-group image, against which draws are depth-tested.
#ifndef DEFERRED_GLSL
#define DEFERRED_GLSL

#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/surface/gbuffer_read.glsl"
#include "shaders/lib/surface/pixel.glsl"
#include "shaders/lib/samples/sample_groups.glsl"

#ifdef STAGE_frag
// Writing gl_SampleMask must not delay the depth test until the shader has run.
layout(early_fragment_tests) in;
#endif

SampleGroup groupHere() { return sampleGroup(depthAt(pixelHere()), constants.group); }

// Number of Surfaces shaded at the pixel.
uint shadedSurfaces() { return multisampled() ? groupsOf(depthAt(pixelHere())) : 1u; }

// Without MSAA only.
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
