// SPDX-License-Identifier: MIT
// The depth that an earlier pass has stored at a pixel, which deferred lighting and, after a depth pre-pass,
// forward+ shade with: Vulkan does not promise that gl_FragCoord.z has the same bits.
#ifndef STORED_DEPTH_GLSL
#define STORED_DEPTH_GLSL

#include "shaders/lib/reversed_depth.glsl"
#include "shaders/lib/samples.glsl"

layout(set = SET_GBUFFER, binding = BINDING_DEPTH) uniform sampler2D gbuffer_depth;
layout(set = SET_GBUFFER, binding = BINDING_DEPTH) uniform sampler2DMS gbuffer_depth_samples;

// Reversed, in [0, 1]. i: the sample, 0 where pixels have one.
float depthAt(ivec2 p, int i) {
    if (multisampled()) return reversedDepth(texelFetch(gbuffer_depth_samples, p, i).r);
    return reversedDepth(texelFetch(gbuffer_depth, p, i).r);
}
float depthAt(ivec2 p) { return depthAt(p, 0); }

#endif
