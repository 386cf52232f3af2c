// SPDX-License-Identifier: MIT
// Moment-based order-independent transparency with four power moments (Muenstermann, Krumpen, Klein and
// Peters 2018, "Moment-Based Order-Independent Transparency"). Gives the transmittance in front of a
// layer, from the moments of all layers' optical depth along the pixel's ray.
#ifndef TRANSPARENCY_MOMENTS_GLSL
#define TRANSPARENCY_MOMENTS_GLSL

#include "shaders/lib/shadows/hamburger.glsl"
#include "shaders/lib/blending/optical_depth.glsl"

layout(set = SET_GBUFFER, binding = BINDING_BLENDED_DEPTHS) uniform texture2D blended_depths;
layout(set = SET_GBUFFER, binding = BINDING_BLENDED_MOMENTS) uniform texture2D blended_moments;

// In [-1, 1], where moments keep the most digits.
float momentDepth(const float z) { return 2.0 * blendedDepth(z) - 1.0; }

vec4 powersOf(const float depth) {
    float square = depth * depth;
    return vec4(depth, square, square * depth, square * square);
}

// Transmittance of all layers in front of reversed depth `z`, and of a quarter of those at it (section 3.3
// of the paper: between the bounds that the moments leave).
float transmittanceBefore(const ivec2 p, const float z) {
    const float BIAS = 5e-7;  // towards an even distribution, for float32 (section 4.1)
    const float OF_THOSE_AT = 0.25;
    float total = texelFetch(blended_depths, p, 0).r;
    vec4 b = texelFetch(blended_moments, p, 0) / max(total, 1e-30);
    b = b * (1.0 - BIAS) + vec4(0.0, 0.375, 0.0, 0.375) * BIAS;
    ThreeDepths places = threeDepths(b, momentDepth(z), 1e-9);
    float fraction = fractionOf(fractionOf(places.before) + OF_THOSE_AT * fractionOf(places.at));
    // The limit keeps float32 above 0: many opaque layers at one depth would otherwise all weigh 0.
    return exp(-min(total * fraction, 60.0));
}

#endif
