// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The first sample of each pixel of several images.
// ATTACHMENTS: 1 to 4
#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = 0) uniform sampler2DMS image_0;
layout(set = SET_GBUFFER, binding = 1) uniform sampler2DMS image_1;
layout(set = SET_GBUFFER, binding = 2) uniform sampler2DMS image_2;
layout(set = SET_GBUFFER, binding = 3) uniform sampler2DMS image_3;

layout(location = 0) out vec4 out_texel[ATTACHMENTS];

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    out_texel[0] = texelFetch(image_0, p, 0);
#if ATTACHMENTS > 1
    out_texel[1] = texelFetch(image_1, p, 0);
#endif
#if ATTACHMENTS > 2
    out_texel[2] = texelFetch(image_2, p, 0);
#endif
#if ATTACHMENTS > 3
    out_texel[3] = texelFetch(image_3, p, 0);
#endif
}
