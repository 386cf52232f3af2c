// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Resolves a pixel's samples to their mean radiance. With tonemapped_resolve the weight is 1 / (1 +
// largest component), as if a tone curve c / (1 + c) were applied, so that one bright sample does not
// dominate (Karis, "High-quality temporal supersampling", SIGGRAPH 2014).
#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = GBUFFER_ALBEDO) uniform texture2DMS samples;

layout(location = 0) out vec4 out_lit;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    int i = 0;
    do {
        vec3 radiance = texelFetch(samples, p, i).rgb;
        float weight = 1.0;
        if (on(feature_tonemapped_resolve))
            weight = 1.0 / (1.0 + max(max(radiance.r, radiance.g), max(radiance.b, 0.0)));
        sum += radiance * weight;
        weights += weight;
    } while (++i < int(feature_samples));
    out_lit = vec4(sum / weights, 1.0);
}
