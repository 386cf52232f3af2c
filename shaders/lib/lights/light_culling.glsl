// SPDX-License-Identifier: MIT
// The cells that a light is tested against: the slices and the rectangle of tiles that its bounding sphere
// may overlap, without the columns of a row that it cannot overlap. Both light culling shaders test these
// cells only, so they mark the same cells, including false positives.
#ifndef LIGHT_CULLING_GLSL
#define LIGHT_CULLING_GLSL

#include "shaders/lib/lights/light_list_buffers.glsl"
#include "shaders/lib/lights/light_rect.glsl"

const vec2 ALL_DEPTHS = vec2(0.0, MAX_BOUND_RADIUS);

// First and one past the last slice that the bounding sphere may overlap. One more on either side, because
// sliceDepths() widens slices for rounding.
uvec2 slicesOfLight(const LightBound bound) {
    float near = bound.centre.z - bound.radius, far = bound.centre.z + bound.radius;
    if (far < 0.0) return uvec2(0u);
    if (feature_light_lists == LISTS_TILED) return uvec2(0u, 1u);
    return uvec2(max(sliceOf(near), 1u) - 1u, min(sliceOf(far) + 2u, grid.slices));
}

TileSize tileSize() { return TileSize(grid.centre, grid.pixel, float(1u << grid.tile_shift)); }

// Columns [x, y) and rows [z, w) of the tiles that the bounding sphere may overlap at any depth; y >= x
// and w >= z.
uvec4 rectOfLight(const LightBound bound) {
    uvec4 rect = tilesOfSphere(bound.centre, bound.radius, ALL_DEPTHS, tileSize(), grid.tiles);
    return uvec4(rect.x, max(rect.x, rect.y), rect.z, max(rect.z, rect.w));
}

// View depths of a slice, m; all depths for tiles, whatever geometry they contain.
vec2 slabOf(const uint slice) { return feature_light_lists == LISTS_TILED ? ALL_DEPTHS : sliceDepths(slice); }

// Columns [x, y) of a row of tiles that the bounding sphere may overlap in the slab.
uvec2 columnsOfLight(const LightBound bound, const uint row, const vec2 slab) {
    float squared = squaredDistanceToRow(bound.centre, cellBounds(uvec2(0u, row), slab));
    return columnsOfSphere(bound.centre, bound.radius, slab, squared, tileSize(), grid.tiles.x);
}

// Whether the light overlaps the cell of a slice and a tile; the tile is in one of these columns.
bool overlapsCell(const LightBound bound, const uvec2 tile, const uint slice) {
    return overlaps(bound, cellBounds(tile, cellDepths(tile.y * grid.tiles.x + tile.x, slice)));
}

// With lights_in_front a tile has two lists. A light is tested for the list of blended surfaces first. If
// it passes, it is tested for the list of opaque surfaces, whose depths begin at the nearest (Harada,
// McKee and Yang 2013, "Forward+: A Step Toward Film-Style Shading in Real Time", GPU Pro 4).
bool overlapsInFront(const LightBound bound, const uvec2 tile) {
    return overlaps(bound, cellBounds(tile, tile_depths[listInFront(tile.y * grid.tiles.x + tile.x)]));
}

#endif
