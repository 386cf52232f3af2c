// SPDX-License-Identifier: MIT
// Location at which a fragment is shaded under MSAA: the mean of its covered sample locations, which lies
// within its triangle. It comes from the triangle's coverage (gl_SampleMaskIn), whatever the depth test
// leaves of it, so that every pass shades at the same location. lavapipe's centroid follows the samples
// that survive.
#ifndef SAMPLES_GLSL
#define SAMPLES_GLSL

#include "shaders/lib/contract.glsl"

bool multisampled() { return feature_samples > 1; }

// Location of sample i from the pixel's upper left corner, pixels.
vec2 sampleLocation(const uint i) {
    uint low = feature_samples == 4 ? SAMPLE_LOCATIONS_4 : SAMPLE_LOCATIONS_8_LOW;
    uint location = (i < 4 ? low : SAMPLE_LOCATIONS_8_HIGH) >> (8 * (i & 3u));
    return vec2(location & 15u, location >> 4 & 15u) / 16.0;
}

// Mean location of the samples of a mask; the pixel's centre if it is empty.
vec2 locationOf(const uint mask) {
    vec2 sum = vec2(0.0);
    uint i = 0;
    do {
        sum += (mask >> i & 1u) != 0 ? sampleLocation(i) : vec2(0.0);
    } while (++i < feature_samples);
    return mask != 0 ? sum / float(bitCount(mask)) : vec2(0.5);
}

// Texel of GBUFFER_SHADED for a fragment: the samples that its triangle covers, those that an alpha mask
// leaves of them, and its reversed depth.
uvec2 shadedTexel(const uint covered, const uint left, const float z) {
    return uvec2(floatBitsToUint(z), covered | left << MAX_SAMPLES);
}
float depthOfShaded(const uvec2 texel) { return uintBitsToFloat(texel.x); }
vec2 locationOfShaded(const uvec2 texel) { return locationOf(texel.y & ((1u << MAX_SAMPLES) - 1u)); }
uint leftOfShaded(const uvec2 texel) { return texel.y >> MAX_SAMPLES; }

// Samples that a mask's alpha, 0 to 1, covers: the nearest count, so coverage is off by at most half a
// sample. alphaToCoverageEnable depends on the device (lavapipe: ceil(4 alpha)) and reads the first
// attachment, whose alpha is packed bits in a G-buffer.
uint coverageOf(const float alpha) {
    uint order = feature_samples == 4 ? COVERAGE_ORDER_4 : COVERAGE_ORDER_8;
    uint count = uint(clamp(alpha, 0.0, 1.0) * float(feature_samples) + 0.5), mask = 0u, i = 0u;
    do {
        mask |= i < count ? 1u << (order >> (4u * i) & 15u) : 0u;
    } while (++i < feature_samples);
    return mask;
}

#endif
