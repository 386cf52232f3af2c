// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Composites the mean radiance of a pixel's layers. Writes radiance, and in alpha the transmittance.
#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = BINDING_BLENDED_DEPTHS) uniform texture2D blended_depths;
layout(set = SET_GBUFFER, binding = BINDING_BLENDED_SUMS) uniform texture2D blended_sums;

layout(location = 0) out vec4 out_lit;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 sums = texelFetch(blended_sums, p, 0);
    float transmittance = exp(-texelFetch(blended_depths, p, 0).r);
    out_lit = vec4(vec3(0.0), 1.0);  // a pixel without layers
    if (sums.a > 0.0) out_lit = vec4(sums.rgb * ((1.0 - transmittance) / sums.a), transmittance);
}
