// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One thread per tile, 32 lights and range of slices. Tests lights that are candidates of both the tile
// and a slice against their froxel (after Drobot 2017, "Improved Culling for Tiled and Clustered
// Rendering").
#include "shaders/lib/lights/light_culling.glsl"

layout(local_size_x = 64) in;

void main() {
    uint tiles = grid.tiles.x * grid.tiles.y;
    uint tile_index = threadIndex() % tiles, word = threadIndex() / tiles;
    if (word >= grid.words) return;
    uvec2 tile = uvec2(tile_index % grid.tiles.x, tile_index / grid.tiles.x);
    uint in_tile = candidates[tileWord(word, tile_index)];
    uint run = (grid.slices + gl_NumWorkGroups.z - 1u) / gl_NumWorkGroups.z;
    uint slice = gl_WorkGroupID.z * run, end = in_tile != 0u ? min(slice + run, grid.slices) : 0u;
    uint left = 0u, overlapped = 0u, in_front = 0u;
    while (slice < end) {
        // A separate short loop skips slices without candidates.
        while (slice < end && left == 0u) {
            left = in_tile & candidates[sliceWord(word, slice)];
            slice += left == 0u ? 1u : 0u;
        }
        if (left != 0u) {
            uint bit = left & (~left + 1u);
            left ^= bit;
            LightBound bound = boundOf(word * 32u + uint(findLSB(bit)));
            uvec2 columns = columnsOfLight(bound, tile.y, slabOf(slice));
            bool within = columns.x <= tile.x && tile.x < columns.y;
            if (on(feature_lights_in_front)) {
                within = within && overlapsInFront(bound, tile);
                if (within) in_front |= bit;
            }
            if (within && overlapsCell(bound, tile, slice)) overlapped |= bit;
            if (left == 0u) {
                if (overlapped != 0u) masks[maskWord(word, slice * tiles + tile_index)] = overlapped;
                if (on(feature_lights_in_front) && in_front != 0u)
                    masks[maskWord(word, listInFront(tile_index))] = in_front;
                overlapped = 0u;
                ++slice;
            }
        }
    }
}
