// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// A thread a light and slice: it walks the tiles that the light's ball covers there and marks those that it reaches.
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = 64) in;

// Tiles that the interval [low, high] (m, at depths z) covers along one axis: first and one past the last.
uvec2 tilesCovered(float low, float high, vec2 z, float centre, uint tiles) {
    vec2 side = on(feature_orthographic) ? vec2(low, high)
                                         : vec2(low / (low < 0.0 ? z.x : z.y), high / (high < 0.0 ? z.y : z.x));
    float size = float(1u << grid.tile_shift);
    // A hundredth of a pixel for rounding; pixels' centres are half a pixel from an edge.
    vec2 tile = (side / grid.pixel + centre + vec2(-0.01, 0.01)) / size;
    vec2 bounded = clamp(vec2(floor(tile.x), floor(tile.y) + 1.0), 0.0, float(tiles));
    return uvec2(bounded);
}

void main() {
    uint light = gl_GlobalInvocationID.x, slice = gl_GlobalInvocationID.y;
    if (light >= grid.local_lights) return;
    LightBound bound = light_bounds[light];
    vec2 slab = feature_light_lists == LISTS_TILED ? vec2(0.0, MAX_BOUND_RADIUS) : sliceDepths(slice);
    float near = max(max(slab.x, bound.centre.z - bound.radius), 1e-30);
    float far = min(slab.y, bound.centre.z + bound.radius);
    float beyond = max(max(slab.x - bound.centre.z, bound.centre.z - slab.y), 0.0);
    float cut = sqrt(max(bound.radius * bound.radius - beyond * beyond, 0.0));
    vec2 z = vec2(near, max(near, far));
    uvec2 columns = tilesCovered(bound.centre.x - cut, bound.centre.x + cut, z, grid.centre.x, grid.tiles.x);
    uvec2 rows = tilesCovered(bound.centre.y - cut, bound.centre.y + cut, z, grid.centre.y, grid.tiles.y);
    uint width = max(columns.y, columns.x) - columns.x, height = max(rows.y, rows.x) - rows.x;
    uint end = near <= far ? width * height : 0u;
    uint word = light / 32u, bit = 1u << (light % 32u);
    uvec2 tile = uvec2(columns.x, rows.x);
    for (uint i = 0u; i < end; ++i) {
        uint number = tile.y * grid.tiles.x + tile.x;
        vec2 depths = cellDepths(number, slice);
        if (reaches(bound, cellBounds(tile, depths)))
            atomicOr(masks[maskWord(word, slice * grid.tiles.x * grid.tiles.y + number)], bit);
        // Before the farthest opaque there may be transparents, down to the camera.
        if (feature_light_lists == LISTS_TILED && depths.x <= depths.y &&
            reaches(bound, cellBounds(tile, vec2(0.0, depths.y))))
            atomicOr(masks[maskWord(word, grid.cells + number)], bit);
        bool row_ends = tile.x + 1u == columns.y;
        tile = row_ends ? uvec2(columns.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
    }
}
