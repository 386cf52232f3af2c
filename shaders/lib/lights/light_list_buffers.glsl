// SPDX-License-Identifier: MIT
// Buffers and helpers of the compute shaders that build light lists.
#ifndef LIGHT_LIST_BUFFERS_GLSL
#define LIGHT_LIST_BUFFERS_GLSL

#include "shaders/lib/lights/addressed_texels.glsl"
#include "shaders/lib/lights/light_overlap.glsl"

layout(set = SET_LISTS, binding = BINDING_BOUNDS) uniform samplerBuffer bound_texels;
layout(set = SET_LISTS, binding = BINDING_MASKS, scalar) buffer Masks { uint masks[]; };
layout(set = SET_LISTS, binding = BINDING_COUNTS, scalar) buffer Counts { LightListCount counts[]; };
layout(set = SET_LISTS, binding = BINDING_TILE_DEPTHS, scalar) buffer TileDepths { vec2 tile_depths[]; };
layout(set = SET_LISTS, binding = BINDING_USED_WORDS, scalar) buffer UsedWords { uint used_words[]; };
layout(set = SET_LISTS, binding = BINDING_FOUR_BEGINS, scalar) buffer FourBegins { uint four_begins[]; };
layout(set = SET_LISTS, binding = BINDING_OVERFLOW, scalar) buffer Overflow { uint overflowed_lists; };
layout(set = SET_LISTS, binding = BINDING_CANDIDATES, scalar) buffer Candidates { uint candidates[]; };

layout(set = SET_LISTS, binding = BINDING_HEADS, scalar) writeonly buffer Heads { LightListHead heads[]; };
layout(set = SET_LISTS, binding = BINDING_INDICES, scalar) writeonly buffer Indices { uint indices[]; };
layout(set = SET_LISTS, binding = BINDING_LISTED, scalar) writeonly buffer Listed { uint listed[]; };

// List entries, of grid.width lights, for `lights` lights; at least one if the scene has any of
// their type.
uint entriesOf(const uint lights, const bool any) {
    return max((lights + grid.width - 1u) / grid.width, any ? 1u : 0u);
}

// Sums a list's counts over its segments; `begin` is the list's first entry.
LightListCount countOf(const uint list) {
    LightListCount sum =
        LightListCount(0u, 0u, 0u, four_begins[list / 4u] + counts[list * grid.segments].begin);
    for (uint i = list * grid.segments; i < (list + 1u) * grid.segments; ++i) {
        sum.all += counts[i].all;
        sum.points += counts[i].points;
        sum.points_and_spots += counts[i].points_and_spots;
    }
    return sum;
}

// The list's first entry and the ends of its light-type segments.
LightListHead headOf(const LightListCount count) {
    LightListHead head;
    head.begin = count.begin;
    head.point_end = head.begin + entriesOf(count.points, grid.point_end > 0u);
    head.spot_end =
        head.point_end + entriesOf(count.points_and_spots - count.points, grid.spot_end > grid.point_end);
    head.end =
        head.spot_end + entriesOf(count.all - count.points_and_spots, grid.local_lights > grid.spot_end);
    return head;
}

vec4 boundTexel(const uint i) {
    if (on(feature_addressed_lights)) return FloatTexels(grid_block.bounds).at[i];
    return texelFetch(bound_texels, int(i));
}
LightBound boundOf(const uint light) {
    vec4 a = boundTexel(3u * light), b = boundTexel(3u * light + 1u), c = boundTexel(3u * light + 2u);
    return LIGHT_BOUND_OF_TEXELS(a, b, c);
}

// Mask words are stored word by word, not list by list: neighbouring threads process neighbouring lists
// and so read adjacent words.
uint maskWord(const uint word, const uint list) { return word * grid.list_stride + list; }

// Index of a word of a tile's or a slice's candidates; also stored word by word.
uint tileWord(const uint word, const uint tile) {
    return word * (grid.tiles.x * grid.tiles.y + grid.slices) + tile;
}
uint sliceWord(const uint word, const uint slice) {
    return tileWord(word, grid.tiles.x * grid.tiles.y + slice);
}

// Linear thread index in a dispatch of rows of workgroups.
uint threadIndex() {
    return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
}

// View depths of a cell, m; for tiles, the depths of the geometry in them.
vec2 cellDepths(const uint tile, const uint slice) {
    return feature_light_lists == LISTS_TILED ? tile_depths[tile] : sliceDepths(slice);
}

// Bits of mask word `word` for light indices below `end`.
uint bitsBelow(const uint word, const uint end) {
    uint first = word * 32u;
    return end <= first ? 0u : end - first >= 32u ? ~0u : (1u << (end - first)) - 1u;
}

#endif
