// SPDX-License-Identifier: MIT
// The light grid: the cell of a pixel, and the bounds of a cell (shared/contract/light_list.h).
#ifndef LIGHT_GRID_GLSL
#define LIGHT_GRID_GLSL

#include "shaders/lib/geometry/view.glsl"

uint sliceOf(const float depth) {
    uint steps = floatBitsToUint(max(depth, 0.0) + grid.slice_offset) - floatBitsToUint(grid.slice_offset);
    return min(steps >> grid.slice_shift, grid.slices - 1u);
}

// `pixel`: gl_FragCoord.xy; depth: view depth, m.
uint cellOf(const vec2 pixel, const float depth) {
    uvec2 tile = uvec2(pixel) >> grid.tile_shift;
    uint slice = feature_light_lists == LISTS_CLUSTERED ? sliceOf(depth) : 0u;
    return (slice * grid.tiles.y + tile.y) * grid.tiles.x + tile.x;
}

// Tiled lists: index of a tile's list for blended surfaces, from that for opaque ones (LightGrid::lists).
uint listInFront(const uint list) { return grid.tiles.x * grid.tiles.y + list; }

// View depths of a slice, m, widened by the rounding of sliceOf(). The first slice begins at the camera;
// the last has no end.
vec2 sliceDepths(const uint slice) {
    uint first = floatBitsToUint(grid.slice_offset) + (slice << grid.slice_shift);
    vec2 sum = vec2(uintBitsToFloat(first), uintBitsToFloat(first + (1u << grid.slice_shift)));
    vec2 depths = sum - grid.slice_offset + vec2(-1e-6, 1e-6) * sum;
    return vec2(slice == 0u ? 0.0 : depths.x, slice + 1u == grid.slices ? MAX_BOUND_RADIUS : depths.y);
}

// A cell: two pairs of planes through the camera, given as x and y over depth (orthographic: x and y in
// m), and a range of view depths.
struct CellBounds {
    vec2 x, y;
    vec2 depth;  // m; empty if depth.x > depth.y
};

CellBounds cellBounds(const uvec2 tile, const vec2 depth) {
    vec4 edges = vec4(tile << grid.tile_shift, (tile + 1u) << grid.tile_shift);
    vec4 sides = (edges - grid.centre.xyxy) * grid.pixel;
    return CellBounds(sides.xz, sides.yw, depth);
}

#endif
