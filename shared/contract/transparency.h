// SPDX-License-Identifier: MIT
// Per-pixel data of blended surfaces for order-independent transparency, before they are composited.
#ifndef DIPTYCH_CONTRACT_TRANSPARENCY_H
#define DIPTYCH_CONTRACT_TRANSPARENCY_H

#include "types.h"

// Bindings of SET_GBUFFER after depth.
// number  name  kind  contents
// clang-format off
#define TRANSPARENCY_BINDINGS(X)                                                                            \
    X(14, BLENDED_DEPTHS, fetched_image, "R32F: sums of optical depth")                                     \
    X(15, BLENDED_MOMENTS, fetched_image,                                                                   \
      "RGBA32F: sums of optical depth times the first four powers of depth")                                \
    X(16, BLENDED_SUMS, fetched_image, "RGBA32F: sums of weighted radiance, and of weighted opacity")       \
    X(17, FRAGMENT_KEYS, storage_buffer,                                                                    \
      "uint64[]: keys, sums, counters: shaders/lib/blending/fragment_list.glsl")                            \
    X(18, FRAGMENTS, storage_buffer, "vec4[layers][pixels]: radiance times opacity, W/(sr m^2), opacity")

// After the channels of surface_channels.h.
#define BACKDROP_BINDINGS(X) \
    X(31, BACKDROP, fetched_image, \
      "RGBA32F, mip-mapped: radiance behind surfaces with transmission, W/(sr m^2)")
// clang-format on

CONTRACT_BEGIN
TRANSPARENCY_BINDINGS(CONTRACT_BINDING)
BACKDROP_BINDINGS(CONTRACT_BINDING)

// Push constants of blended passes and of backdrop.frag, the last members of DrawConstants.
struct BlendedConstants {
    float nearest;   // view distance of the nearest blended surface, m
    float farthest;  // view distance of the farthest, m
    // Fragment lists: capacity per pixel, and the rows that the buffers cover. backdrop.frag: the size of
    // the level that it draws, as width and rows.
    uint layers;
    uint width;
    uint first_row;
    uint rows;
};

// Values per pixel next to the keys of its fragments: sums over the fragments that overflowed. Fixed
// point, with FRAGMENT_SUM_UNIT as 1: radiance times opacity (3), opacity, optical depth.
CONTRACT_CONST(uint, FRAGMENT_SUMS, 5);
CONTRACT_CONST(float, FRAGMENT_SUM_UNIT, 5.9604644775390625e-8f);  // 2^-24
// Largest value that one fragment adds, 2^28: 2,048 of them fit in 63 bits.
CONTRACT_CONST(float, FRAGMENT_SUM_MAX, 268435456.0f);
// Values per image after them: number of fragments that overflowed, and of pixels with fragments.
CONTRACT_CONST(uint, FRAGMENT_COUNTERS, 2);
// Optical depth of an opaque layer. Plain sums use 80: transmittance e^-80 is 0 in float32. Moments use
// 10: a layer of 80 would leave no precision for the others.
CONTRACT_CONST(float, MAX_OPTICAL_DEPTH, 80.0f);
CONTRACT_CONST(float, MAX_OPTICAL_DEPTH_OF_MOMENTS, 10.0f);

CONTRACT_END

#endif
