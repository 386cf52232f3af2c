// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Largest value over a pixel's samples.
#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = GBUFFER_ALBEDO) uniform texture2DMS samples;

layout(location = 0) out vec4 out_texel;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 largest = texelFetch(samples, p, 0);
    int i = 1;
    do {
        largest = max(largest, texelFetch(samples, p, i));
    } while (++i < int(feature_samples));
    out_texel = largest;
}
