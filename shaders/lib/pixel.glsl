// SPDX-License-Identifier: MIT
// The pixel that an invocation shades: its fragment's, or of a compute shader the one of its place in its
// workgroup, a square of LIGHTING_GROUP pixels. Eight threads that follow each other, and so the lanes of
// lavapipe, shade four pixels of two rows, as the fragments lie that it shades together.
#ifndef PIXEL_GLSL
#define PIXEL_GLSL

#include "shaders/lib/contract.glsl"

#ifdef STAGE_comp

layout(local_size_x = int(LIGHTING_GROUP * LIGHTING_GROUP)) in;

#if SAMPLES
#define TARGET_IMAGE image2DMS
#else
#define TARGET_IMAGE image2D
#endif
layout(set = SET_GBUFFER, binding = BINDING_LIT_TARGET, rgba32f) writeonly uniform TARGET_IMAGE lit_target;

ivec2 pixelHere() {
    uint i = gl_LocalInvocationIndex;
    uvec2 inside = uvec2((i & 3u) | (i >> 1 & 4u), (i >> 2 & 1u) | (i >> 3 & 6u));
    return ivec2(gl_WorkGroupID.xy * LIGHTING_GROUP + inside);
}

// Workgroups at the right and lower edge have threads beyond the picture.
bool isInPicture() { return all(lessThan(pixelHere(), imageSize(lit_target))); }

#else

ivec2 pixelHere() { return ivec2(gl_FragCoord.xy); }

#endif

// gl_FragCoord.xy of a fragment at the pixel's middle.
vec2 middleHere() { return vec2(pixelHere()) + 0.5; }

#endif
