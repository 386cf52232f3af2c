// SPDX-License-Identifier: MIT
// List of secondary sample groups (shared/contract/samples.h). If few pixels have any, the pass that
// shades them runs one fragment per group. lavapipe shades every fragment of a multisampled draw, even if
// no sample passes the depth test.
#ifndef FURTHER_GROUPS_GLSL
#define FURTHER_GROUPS_GLSL

#include "shaders/lib/geometry/draw.glsl"

#ifdef STAGE_vert
#define FURTHER_ACCESS readonly
#else
#define FURTHER_ACCESS
#endif
layout(set = SET_GBUFFER, binding = BINDING_FURTHER_COUNT, r32ui)
FURTHER_ACCESS uniform uimage2D further_count;
layout(set = SET_GBUFFER, binding = BINDING_FURTHER_LIST, r32ui)
FURTHER_ACCESS uniform uimage2D further_list;

ivec2 indexInList(const uint entry) {
    return ivec2(entry & (FURTHER_WIDTH - 1u), entry >> FURTHER_WIDTH_BITS);
}

uint listedGroup(const ivec2 p, const uint k) {
    return (k << FURTHER_PIXEL_BITS | uint(p.y)) << FURTHER_PIXEL_BITS | uint(p.x);
}
ivec2 pixelOfListed(const uint word) {
    uint mask = (1u << FURTHER_PIXEL_BITS) - 1u;
    return ivec2(word & mask, word >> FURTHER_PIXEL_BITS & mask);
}
uint groupOfListed(const uint word) { return word >> 2u * FURTHER_PIXEL_BITS; }

// Index of the list entry that a fragment of draw `page` shades. Consecutive entries alternate between two
// rows: fragments are shaded in blocks, and neighbouring pixels loop over similar light lists.
uint entryAt(const uvec2 fragment, const uint page) {
    return (page * (FURTHER_ROWS / 2u) + (fragment.y >> 1) << FURTHER_WIDTH_BITS | fragment.x) << 1 |
           fragment.y & 1u;
}

// Rows of draw `page` that `count` entries need, as a fraction of FURTHER_ROWS.
float rowsOf(const uint count, const uint page) {
    uint row = 2u * FURTHER_WIDTH, before = page * (FURTHER_ROWS / 2u) * row;
    uint left = count > before ? count - before : 0u;
    return min(float(2u * ((left + row - 1u) / row)) / float(FURTHER_ROWS), 1.0);
}

#endif
