// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One thread per four lists, whose masks share a texel. Counts the lights in each segment, marks the words
// that are not empty, and counts the list entries.
#include "shaders/lib/lights/light_list_buffers.glsl"

layout(local_size_x = 64) in;

layout(set = SET_LISTS, binding = BINDING_MASK_TEXELS) uniform usamplerBuffer mask_texels;

uvec4 maskTexel(const uint i) {
    if (on(feature_addressed_lights)) return WordTexels(grid_block.masks).at[i];
    return texelFetch(mask_texels, int(i));
}

struct FourCounts {
    uvec4 all, points, points_and_spots;
};

// Entries of four lists; 0 beyond the last list.
uvec4 entriesOfFour(const FourCounts sum, const uint four) {
    uvec4 result = uvec4(0u);
    for (uint i = 0u; i < 4u; ++i) {
        uint end = headOf(LightListCount(sum.all[i], sum.points[i], sum.points_and_spots[i], 0u)).end;
        result[i] = four * 4u + i < grid.lists ? end : 0u;
    }
    return result;
}

void main() {
    uint four = gl_GlobalInvocationID.x, row = grid.list_stride / 4u;
    if (four >= row) return;
    bool points_alone = !on(feature_spot_lights) && !on(feature_area_lights);
    FourCounts sum = FourCounts(uvec4(0u), uvec4(0u), uvec4(0u)), before = sum;
    for (uint first = 0u; first < grid.words; first += 32u) {
        uvec4 used = uvec4(0u);
        uint end = min(first + 32u, grid.words);
        for (uint word = first; word < end; ++word) {
            uvec4 mask = maskTexel(word * row + four);
            used |= uvec4(notEqual(mask, uvec4(0u))) << (word - first);
            sum.all += uvec4(bitCount(mask));
            if (!points_alone) {
                sum.points += uvec4(bitCount(mask & bitsBelow(word, grid.point_end)));
                sum.points_and_spots += uvec4(bitCount(mask & bitsBelow(word, grid.spot_end)));
            }
        }
        for (uint i = 0u; i < 4u; ++i) used_words[maskWord(first / 32u, four * 4u + i)] = used[i];
        if (points_alone) sum.points = sum.points_and_spots = sum.all;
        // End of a segment.
        if (end % SEGMENT_WORDS == 0u || end == grid.words) {
            for (uint i = 0u; i < 4u; ++i) {
                uint list = four * 4u + i;
                if (list < grid.lists)
                    counts[list * grid.segments + first / SEGMENT_WORDS] =
                        LightListCount(sum.all[i] - before.all[i], sum.points[i] - before.points[i],
                                       sum.points_and_spots[i] - before.points_and_spots[i], 0u);
            }
            before = sum;
        }
    }
    uvec4 entries = entriesOfFour(sum, four);
    uvec4 begin = uvec4(0u, entries.x, entries.x + entries.y, entries.x + entries.y + entries.z);
    for (uint i = 0u; i < 4u; ++i)
        if (four * 4u + i < grid.lists) counts[(four * 4u + i) * grid.segments].begin = begin[i];
    four_begins[four] = begin.w + entries.w;
}
