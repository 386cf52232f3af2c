// SPDX-License-Identifier: MIT
// Depth that an earlier pass stored at a pixel. Deferred lighting, and forward+ after a depth pre-pass,
// shade with it: Vulkan does not guarantee that gl_FragCoord.z has the same bits.
#ifndef STORED_DEPTH_GLSL
#define STORED_DEPTH_GLSL

#include "shaders/lib/geometry/reversed_depth.glsl"
#include "shaders/lib/samples/samples.glsl"

layout(set = SET_GBUFFER, binding = BINDING_DEPTH) uniform texture2D gbuffer_depth;
layout(set = SET_GBUFFER, binding = BINDING_DEPTH) uniform texture2DMS gbuffer_depth_samples;

// Reversed, in [0, 1]. i: sample index; 0 without MSAA.
float depthAt(const ivec2 p, const int i) {
    if (multisampled()) return reversedDepth(texelFetch(gbuffer_depth_samples, p, i).r);
    return reversedDepth(texelFetch(gbuffer_depth, p, i).r);
}
float depthAt(const ivec2 p) { return depthAt(p, 0); }

#endif
