// SPDX-License-Identifier: MIT
// Which lights a pixel evaluates: the cells that the picture is cut into and the lists that they hold.
#ifndef DIPTYCH_CONTRACT_LIGHT_LIST_H
#define DIPTYCH_CONTRACT_LIGHT_LIST_H

#include "types.h"

CONTRACT_BEGIN

// Values of FEATURE_light_lists.
CONTRACT_CONST(uint, LISTS_NONE, 0);       // every light at every pixel
CONTRACT_CONST(uint, LISTS_CLUSTERED, 1);  // a cell is a froxel: a tile of pixels x a slice of view depth
CONTRACT_CONST(uint, LISTS_TILED, 2);      // a cell is a tile with the depths that it covers

// Values of FEATURE_light_chunk. Lists of more groups than MAX_LIGHTS_PER_DRAW are walked by several draws,
// which hand the float32 sums on: so the sum is the same bits as one loop's.
CONTRACT_CONST(uint, CHUNK_WHOLE, 0);
CONTRACT_CONST(uint, CHUNK_FIRST, 1);  // directional lights and the first groups
CONTRACT_CONST(uint, CHUNK_LATER, 2);  // goes on from SET_CARRIED

// Cells over a picture, numbered (slice * tiles.y + tile y) * tiles.x + tile x. Lists are of local lights
// (point, spot, area): directional ones reach everything. Light numbers count from the first local one.
struct LightGrid {
    uvec2 tiles;         // across, down; the last column and row may be cut off
    uint tile_shift;     // a tile is 1 << tile_shift pixels wide and high
    uint slices;         // of depth; 1 where tiled
    float slice_offset;  // m: slice = (bits of (depth + offset) - bits of offset) >> shift, as integers, at
    uint slice_shift;    //   most slices - 1: steps that grow with depth and are exact to tell, without a log
    uint cells;          // tiles.x * tiles.y * slices; tiled: of opaque lists, those of transparents follow
    uint lists;          // cells, or twice as many where tiled
    uint list_stride;    // lists of one row of the masks: a multiple of four
    uint local_lights;
    uint first_local;    // directional lights before them
    uint point_end;      // numbers of points are below it,
    uint spot_end;       // of spots below this
    uint words;          // of 32 lights each, of a list's mask
    uint segments;       // a list's words are counted and written in so many parts, SEGMENT_WORDS each
    uint width;          // lights of a group: lists are made of whole ones; FEATURE_list_width
    uint null_light;     // what fills a group up
    uint capacity;       // groups that the index buffer holds
    uint all_point_end;  // the list of all local lights begins at group 0; the ends of its parts
    uint all_spot_end;
    uint all_end;
    vec2 centre;  // pixel coordinates of the optical axis
    float pixel;  // side of a pixel in m per m of depth; orthographic: in m
};

// Where a light is felt, for culling alone: nothing outside of both sphere and cone. In view axes from the
// camera: x right, y down, z forward; m. Widened by more than float32 can round.
struct LightBound {
    vec3 centre;
    float radius;    // at most MAX_BOUND_RADIUS, and then around the camera: everywhere
    vec3 apex;       // of the cone: the light
    float cos_cone;  // half the opening angle; -1: all directions
    vec3 axis;       // unit
    float sin_cone;
};

// How many lights of one list's segment there are, and of these the points, and the points and spots.
struct LightListCount {
    uint all, points, points_and_spots;
    uint begin;  // of a list's first segment: groups of the lists before it in its row of four
};

// A list: groups [begin, end) of the index buffer in the order of the lights, points before point_end, spots
// before spot_end; a part has at least one group where the scene has such lights at all. A list that found no
// room is the one of all local lights, which begins at 0.
struct LightListHead {
    uint begin, point_end, spot_end, end;
};

CONTRACT_CONST(uint, LIGHT_TILE, 16);       // pixels, of tiled: one of its 256 threads each
CONTRACT_CONST(uint, SEGMENT_WORDS, 1024);  // 32,768 lights: a loop over them ends before lavapipe's limit
CONTRACT_CONST(uint, LIST_GROUP, 256);      // threads of a workgroup of the kernels
CONTRACT_CONST(uint, SCATTER_THREADS, 8);   // share a light's cells out among them
CONTRACT_CONST(float, MAX_BOUND_RADIUS,
               4e18f);  // m, over twice as far as anything may be; its square stays finite

// SET_LISTS, of the kernels that make lists.
CONTRACT_CONST(uint, BINDING_BOUNDS, 0);  // buffer LightBound[local_lights]
CONTRACT_CONST(uint, BINDING_MASKS, 1);  // buffer uint[words][list_stride]: bit i of word w is light 32 w + i
CONTRACT_CONST(uint, BINDING_COUNTS, 2);       // buffer LightListCount[lists][segments]
CONTRACT_CONST(uint, BINDING_TILE_DEPTHS, 3);  // buffer vec3[tiles]: least, largest and visible view depth, m
CONTRACT_CONST(uint, BINDING_OVERFLOW, 4);     // buffer uint: lists that found no room
CONTRACT_CONST(uint, BINDING_LISTS_DEPTH, 5);  // texture: the picture's depth
CONTRACT_CONST(uint, BINDING_HEADS, 6);        // buffer LightListHead[lists]
CONTRACT_CONST(uint, BINDING_INDICES, 7);      // buffer uint[capacity * width]
CONTRACT_CONST(uint, BINDING_LISTED, 8);       // buffer uint[lists]: lights of each, for channels
CONTRACT_CONST(uint, BINDING_USED_WORDS,
               9);  // buffer uint[words / 32][list_stride]: which words have any bits
CONTRACT_CONST(uint, BINDING_FOUR_BEGINS,
               10);  // buffer uint[list_stride / 4]: groups of four lists, then where they begin
CONTRACT_CONST(uint, BINDING_MASK_TEXELS, 11);  // the masks again, a row's lists four a texel

CONTRACT_END

#endif
