// SPDX-License-Identifier: MIT
// The depth that an earlier pass has stored at a pixel, which deferred lighting and, after a depth pre-pass,
// forward+ shade with: Vulkan does not promise that gl_FragCoord.z has the same bits.
#ifndef STORED_DEPTH_GLSL
#define STORED_DEPTH_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = BINDING_DEPTH) uniform sampler2D gbuffer_depth;

// Reversed, in [0, 1].
float depthAt(ivec2 p) { return texelFetch(gbuffer_depth, p, 0).r; }

#endif
