// SPDX-License-Identifier: MIT
// The pixel that an invocation shades. A fragment shader shades its own; a compute shader's workgroup
// shades a square of LIGHTING_GROUP pixels, of the image or of a listed tile. Eight consecutive threads,
// lavapipe's lanes, shade 4 x 2 pixels, like the fragments that lavapipe shades together.
#ifndef PIXEL_GLSL
#define PIXEL_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/samples/samples.glsl"

#ifdef STAGE_comp

#include "shaders/lib/geometry/lighting_tiles.glsl"

layout(local_size_x = int(LIGHTING_GROUP * LIGHTING_GROUP)) in;

layout(set = SET_GBUFFER, binding = BINDING_LIT_TARGET, rgba32f) writeonly uniform image2D lit_target;
layout(set = SET_GBUFFER, binding = BINDING_LIT_TARGET, rgba32f) writeonly uniform image2DMS lit_samples;

// Column and row of the workgroup's square in the image.
uvec2 squareOfWorkgroup() {
    if (!on(feature_lighting_tiles)) return gl_WorkGroupID.xy;
    uint across = LIGHTING_TILE / LIGHTING_GROUP;
    uvec2 inside = uvec2(gl_WorkGroupID.x % across, gl_WorkGroupID.x / across);
    return listedTile(gl_WorkGroupID.y) * across + inside;
}
uvec2 square = squareOfWorkgroup();

ivec2 pixelHere() {
    uint i = gl_LocalInvocationIndex;
    uvec2 inside = uvec2((i & 3u) | (i >> 1 & 4u), (i >> 2 & 1u) | (i >> 3 & 6u));
    return ivec2(square * LIGHTING_GROUP + inside);
}

// Workgroups at the right and lower edge extend beyond the image.
bool isInImage() {
    ivec2 size = multisampled() ? imageSize(lit_samples) : imageSize(lit_target);
    return all(lessThan(pixelHere(), size));
}

#else

ivec2 pixelHere() { return ivec2(gl_FragCoord.xy); }

#endif

// gl_FragCoord.xy at the pixel's centre.
vec2 middleHere() { return vec2(pixelHere()) + 0.5; }

#endif
