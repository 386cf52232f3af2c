// SPDX-License-Identifier: MIT
// Where in its pixel a fragment is shaded that covers several samples: at the mean of their places, which
// lies within its triangle. A triangle's coverage says so (gl_SampleMaskIn) whatever depth tests leave of it,
// so that every pass that draws it shades at one place; lavapipe's centroid follows the samples that survive.
#ifndef SAMPLES_GLSL
#define SAMPLES_GLSL

#include "shaders/lib/contract.glsl"

bool multisampled() { return feature_samples > 1; }

// Of sample i, from the pixel's upper left corner, pixels.
vec2 samplePlace(uint i) {
    uint low = feature_samples == 4 ? SAMPLE_PLACES_4 : SAMPLE_PLACES_8_LOW;
    uint place = (i < 4 ? low : SAMPLE_PLACES_8_HIGH) >> (8 * (i & 3u));
    return vec2(place & 15u, place >> 4 & 15u) / 16.0;
}

// The mean place of the samples of a mask; the pixel's middle of none.
vec2 placeOf(uint mask) {
    vec2 sum = vec2(0.0);
    uint i = 0;
    do {
        sum += (mask >> i & 1u) != 0 ? samplePlace(i) : vec2(0.0);
    } while (++i < feature_samples);
    return mask != 0 ? sum / float(bitCount(mask)) : vec2(0.5);
}

#endif
