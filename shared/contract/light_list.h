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

// Values of FEATURE_light_batch. Lists of more packets than a device's draw may walk are walked in batches by
// several draws. Each continues from the float32 sums of the one before it, so the sums have the same bits as
// one loop's.
CONTRACT_CONST(uint, BATCH_WHOLE, 0);  // the whole list
CONTRACT_CONST(uint, BATCH_FIRST, 1);  // directional lights and the first packets
CONTRACT_CONST(uint, BATCH_LATER, 2);  // continues from SET_PARTIAL_SUMS

// Cells over a picture, numbered (slice * tiles.y + tile y) * tiles.x + tile x. Lists are of local lights
// (point, spot, area): directional ones reach everything. Light numbers count from the first local one.
struct LightGrid {
    uvec2 tiles;         // across, down; the last column and row may be cut off
    uint tile_shift;     // a tile is 1 << tile_shift pixels wide and high
    uint slices;         // of depth; 1 where tiled
    float slice_offset;  // m: slice = (bits of (depth + offset) - bits of offset) >> shift, as integers, at
    uint slice_shift;    //   most slices - 1: steps that grow with depth and are exact to tell, without a log
    uint lists;        // one a cell: tiles.x * tiles.y * slices; of tiles with lights_in_front as many again
                       //   behind them, of what is blended: from the viewer on
    uint list_stride;  // lists of one row of the masks: a multiple of four
    uint local_lights;
    uint first_local;    // directional lights before them
    uint point_end;      // numbers of points are below it,
    uint spot_end;       // of spots below this
    uint words;          // of 32 lights each, of a list's mask
    uint segments;       // a list's words are counted and written in so many parts, SEGMENT_WORDS each
    uint width;          // lights of a packet: 1 or 4; lists consist of whole packets; FEATURE_list_width
    uint null_light;     // pads the last packet of a part
    uint capacity;       // packets that the index buffer holds
    uint all_point_end;  // the list of all local lights begins at packet 0; the ends of its parts
    uint all_spot_end;
    uint all_end;
    vec2 centre;  // pixel coordinates of the optical axis
    float pixel;  // side of a pixel in m per m of depth; orthographic: in m
    // Addresses of the lists' buffers, for FEATURE_addressed_lights.
    uvec2 heads;
    uvec2 indices;
    uvec2 bounds;
    uvec2 masks;
};

// The region that a light can reach, for culling alone: what lies inside both a bounding sphere and a cone.
// In view axes from the camera: x right, y down, z forward; m. Widened by more than float32 can round.
// Shaders read it as texels.
struct LightBound {
    vec3 centre;
    float radius;    // at most MAX_BOUND_RADIUS; a sphere of that radius is around the camera and reaches
                     // everything
    vec3 apex;       // of the cone: the light
    float cos_cone;  // half the opening angle; -1: all directions
    vec3 axis;       // unit
    float sin_cone;
};
#define LIGHT_BOUND_OF_TEXELS(a, b, c) LightBound(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_LANE(LightBound, centre, 0, 0);
CONTRACT_LANE(LightBound, radius, 0, 3);
CONTRACT_LANE(LightBound, apex, 1, 0);
CONTRACT_LANE(LightBound, cos_cone, 1, 3);
CONTRACT_LANE(LightBound, axis, 2, 0);
CONTRACT_LANE(LightBound, sin_cone, 2, 3);
CONTRACT_TEXELS(LightBound, 3);

// How many lights of one list's segment there are, and of these the points, and the points and spots.
struct LightListCount {
    uint all, points, points_and_spots;
    uint begin;  // of a list's first segment: packets of the lists before it among its four
};

// A list: packets [begin, end) of the index buffer in the order of the lights, points before point_end, spots
// before spot_end; a part has at least one packet where the scene has such lights at all. A list that found
// no room is the list of all local lights, which begins at 0. Shaders read it as one texel.
struct LightListHead {
    uint begin, point_end, spot_end, end;
};
#define LIGHT_LIST_HEAD_OF_TEXEL(a) LightListHead(a.x, a.y, a.z, a.w)
CONTRACT_LANE(LightListHead, begin, 0, 0);
CONTRACT_LANE(LightListHead, point_end, 0, 1);
CONTRACT_LANE(LightListHead, spot_end, 0, 2);
CONTRACT_LANE(LightListHead, end, 0, 3);
CONTRACT_TEXELS(LightListHead, 1);

CONTRACT_CONST(uint, LIGHT_TILE, 16);       // pixels, of tiled: four for each of 64 threads
CONTRACT_CONST(uint, SEGMENT_WORDS, 1024);  // 32,768 lights: a loop over them stays below lavapipe's limit
CONTRACT_CONST(uint, LIST_GROUP, 256);      // threads of the workgroup of the prefix sum
CONTRACT_CONST(uint, LIGHT_THREADS, 8);     // threads that divide a light's cells among them
CONTRACT_CONST(float, MAX_BOUND_RADIUS,
               4e18f);  // m, over twice as far as anything may be; its square stays finite

CONTRACT_END

// SET_LISTS, of the kernels that make lists; columns as in bindings.h.
// clang-format off
#define LIST_BINDINGS(X)                                                                                  \
    X(0,  BOUNDS,      texel_buffer,   "LightBound[local_lights], three texels each")                     \
    X(1,  MASKS,       storage_buffer, "uint[words][list_stride]: bit i of word w is light 32 w + i")     \
    X(2,  COUNTS,      storage_buffer, "LightListCount[lists][segments]")                                 \
    X(3,  TILE_DEPTHS, storage_buffer, "vec2[lists]: least and largest view depth of a tile's list, m")    \
    X(4,  OVERFLOW,    storage_buffer, "uint: number of lists that overflowed")                           \
    X(5,  LISTS_DEPTH, image,          "the picture's depth")                                             \
    X(6,  HEADS,       storage_buffer, "LightListHead[lists + 1]: the last one lists all local lights")   \
    X(7,  INDICES,     storage_buffer, "uint[capacity * width]")                                          \
    X(8,  LISTED,      storage_buffer, "uint[2 lists + 1]: lights of each list, for channels; then with"  \
                                       " several samples the bits of the largest view depth of each tile") \
    X(9,  USED_WORDS,  storage_buffer, "uint[words / 32][list_stride]: which words have any bits")        \
    X(10, FOUR_BEGINS, storage_buffer, "uint[list_stride / 4]: packets of four lists, then their begins") \
    X(11, MASK_TEXELS, texel_buffer,   "the masks again, four lists of a row per texel")                  \
    X(12, CANDIDATES,  storage_buffer, "uint[words][tiles + slices]: as masks, of whole tiles and slices")
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_BINDING_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);
LIST_BINDINGS(DIPTYCH_BINDING_NUMBER)
#undef DIPTYCH_BINDING_NUMBER
CONTRACT_END

#endif
