// SPDX-License-Identifier: MIT
// Tiles of deferred lighting. If the G-buffer stores layers, two shader variants light the image: one
// without layers in the tiles that have none, one with all layers of the scene in the others.
#ifndef DIPTYCH_CONTRACT_LIGHTING_TILES_H
#define DIPTYCH_CONTRACT_LIGHTING_TILES_H

#include "types.h"

CONTRACT_BEGIN

// Side in pixels of the square that a workgroup of deferred lighting shades. The side of a light list's
// tile is a multiple of it, so the square lies in one tile.
CONTRACT_CONST(uint, LIGHTING_GROUP, 8);

// Side in pixels, a multiple of LIGHTING_GROUP. Two triangles draw a tile, and devices shade the blocks of
// pixels on their common edge twice: an eighth of this tile in blocks of 4 x 2 pixels, a quarter of one half
// as wide. In wider tiles more pixels of the base pay for a layer beside them.
CONTRACT_CONST(uint, LIGHTING_TILE, 32);
CONTRACT_CONST(uint, LIGHTING_TILE_GROUPS, 16);  // workgroups of a tile: (LIGHTING_TILE / LIGHTING_GROUP)^2

// Classes of tiles.
CONTRACT_CONST(uint, TILES_BASE, 0);     // no sample of the tile stores a layer
CONTRACT_CONST(uint, TILES_LAYERED, 1);  // the others
CONTRACT_CONST(uint, TILE_CLASSES, 2);

// Tiles that one indirect dispatch shades, at most. A class has a dispatch for each of this many tiles of the
// image, so that long ones can be submitted one by one.
CONTRACT_CONST(uint, TILES_PER_DISPATCH, 128);

CONTRACT_CONST(uint, TILE_LIST_THREADS, 256);  // of the workgroup that lists the tiles

// VkDrawIndirectCommand and VkDispatchIndirectCommand.
struct TileDraw {
    uint vertices;
    uint instances;
    uint first_vertex;
    uint first_instance;
};
struct TileDispatch {
    uint groups;  // of a tile
    uint tiles;
    uint one;
};

// Push constants of the compute shaders that classify and list tiles. An address is (low word, high word).
struct TileConstants {
    uvec2 classes;     // uint[tiles]: class of each tile, row by row
    uvec2 draws;       // TileDraw[TILE_CLASSES]
    uvec2 dispatches;  // TileDispatch[TILE_CLASSES][]
    uvec2 lists;       // uint[TILE_CLASSES][tiles]: the tiles of each class, x | y << 16
    uvec2 size;        // tiles across, down
};

CONTRACT_END

#endif
