// SPDX-License-Identifier: MIT
// The tiles that a draw or dispatch of deferred lighting shades (shared/contract/lighting_tiles.h).
#ifndef LIGHTING_TILES_GLSL
#define LIGHTING_TILES_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/lib/geometry/draw.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TileList { uint at[]; };

// Tile i of the list: column, row.
uvec2 listedTile(const uint i) {
    uint word = TileList(constants.tiles).at[i];
    return uvec2(word & 0xffffu, word >> 16);
}

// Corner of the two triangles that cover a tile, at the far end of reversed depth as full_screen.glsl. Tiles
// at the right and lower edge end with the image.
vec4 tileCorner(const uvec2 tile, const int vertex) {
    bool right = vertex == 1 || vertex >= 4, below = vertex == 2 || vertex == 3 || vertex == 5;
    vec2 corner = vec2(tile + uvec2(right, below)) * constants.tile_size - 1.0;
    return vec4(min(corner, vec2(1.0)), 0.0, 1.0);
}

#endif
