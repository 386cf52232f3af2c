// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// A thread a light and slice: it walks the tiles that the light's ball covers there and marks those that it reaches.
#include "shaders/lib/light_kernel.glsl"
#include "shaders/lib/light_rect.glsl"

layout(local_size_x = 64) in;

void main() {
    uint light = gl_GlobalInvocationID.x, slice = gl_GlobalInvocationID.y;
    if (light >= grid.local_lights) return;
    LightBound bound = light_bounds[light];
    vec2 slab = feature_light_lists == LISTS_TILED ? vec2(0.0, MAX_BOUND_RADIUS) : sliceDepths(slice);
    TileSize size = TileSize(grid.centre, grid.pixel, float(1u << grid.tile_shift));
    uvec4 rect = tilesOfBall(bound.centre, bound.radius, slab, size, grid.tiles);
    uint end = (max(rect.y, rect.x) - rect.x) * (max(rect.w, rect.z) - rect.z);
    uint word = light / 32u, bit = 1u << (light % 32u);
    uvec2 tile = rect.xz;
    for (uint i = 0u; i < end; ++i) {
        uint number = tile.y * grid.tiles.x + tile.x;
        vec2 depths = cellDepths(number, slice);
        bool reached = reaches(bound, cellBounds(tile, depths));
        if (feature_light_lists == LISTS_TILED) {
            bool around = reaches(bound, cellBounds(tile, transparentDepths(number)));
            reached = reached && around;  // what rounder bounds keep for nothing
            if (around) atomicOr(masks[maskWord(word, grid.cells + number)], bit);
        }
        if (reached) atomicOr(masks[maskWord(word, slice * grid.tiles.x * grid.tiles.y + number)], bit);
        bool row_ends = tile.x + 1u == rect.y;
        tile = row_ends ? uvec2(rect.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
    }
}
