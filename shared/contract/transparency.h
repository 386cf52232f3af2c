// SPDX-License-Identifier: MIT
// What blended surfaces leave at each pixel before they are put together, where they are not blended one
// over the other as they are drawn.
#ifndef DIPTYCH_CONTRACT_TRANSPARENCY_H
#define DIPTYCH_CONTRACT_TRANSPARENCY_H

#include "types.h"

// Bindings of SET_GBUFFER after depth.
// number  name  kind  what it holds
// clang-format off
#define TRANSPARENCY_BINDINGS(X)                                                                            \
    X(9,  BLENDED_DEPTHS, image, "R32F: sums of optical depth")                                             \
    X(10, BLENDED_MOMENTS, image, "RGBA32F: sums of optical depth times the first four powers of depth")    \
    X(11, BLENDED_SUMS, image, "RGBA32F: sums of weighted radiance, and of weighted opacity")               \
    X(12, FRAGMENT_KEYS, storage_buffer, "uint64[]: keys, sums, counters: shaders/lib/fragment_list.glsl")  \
    X(13, FRAGMENTS, storage_buffer, "vec4[layers][pixels]: radiance times opacity, W/(sr m^2), opacity")
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_BINDING_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);
TRANSPARENCY_BINDINGS(DIPTYCH_BINDING_NUMBER)
#undef DIPTYCH_BINDING_NUMBER

// Push constants of the passes of blended surfaces, the last ones of DrawConstants.
struct BlendedConstants {
    float nearest;   // distance along the view of the nearest blended surface, m
    float farthest;  // likewise; of the farthest
    // Lists of fragments: how many a pixel has room for, and the rows that the buffers hold.
    uint layers;
    uint width;
    uint first_row;
    uint rows;
};

// Numbers of a pixel beside the keys of its fragments: sums over those that found no room, in fixed point
// with FRAGMENT_SUM_UNIT as 1: radiance times opacity (3), opacity, optical depth.
CONTRACT_CONST(uint, FRAGMENT_SUMS, 5);
CONTRACT_CONST(float, FRAGMENT_SUM_UNIT, 5.9604644775390625e-8f);  // 2^-24
// The most that one fragment adds, 2^28: 2,048 of them fit in 63 bits.
CONTRACT_CONST(float, FRAGMENT_SUM_MOST, 268435456.0f);
// Numbers of the whole picture after them: fragments that found no room, and pixels that have some.
CONTRACT_CONST(uint, FRAGMENT_COUNTERS, 2);
// Of a layer that hides all behind it: where depths are added up alone it lets e^-80 through, which is
// nothing in float32; among moments e^-10, as a layer of 80 would leave no digits for the others.
CONTRACT_CONST(float, MOST_OPTICAL_DEPTH, 80.0f);
CONTRACT_CONST(float, MOST_OPTICAL_DEPTH_OF_MOMENTS, 10.0f);

CONTRACT_END

#endif
