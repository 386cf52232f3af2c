// SPDX-License-Identifier: MIT
// The lights that a pixel evaluates: the tiles or froxels of an image and their light lists.
#ifndef DIPTYCH_CONTRACT_LIGHT_LIST_H
#define DIPTYCH_CONTRACT_LIGHT_LIST_H

#include "types.h"

CONTRACT_BEGIN

// Values of FEATURE_light_lists.
CONTRACT_CONST(uint, LISTS_NONE, 0);       // every light at every pixel
CONTRACT_CONST(uint, LISTS_CLUSTERED, 1);  // a cell is a froxel: a tile of pixels x a slice of view depth
CONTRACT_CONST(uint, LISTS_TILED, 2);      // a cell is a tile with its depth range

// Values of FEATURE_light_batch. Long lists are evaluated in batches by several draws. Each draw continues
// from the float32 sums of the previous one, so the result is bit for bit that of one loop.
CONTRACT_CONST(uint, BATCH_WHOLE, 0);  // the whole list
CONTRACT_CONST(uint, BATCH_FIRST, 1);  // directional lights and the first entries
CONTRACT_CONST(uint, BATCH_LATER, 2);  // continues from SET_PARTIAL_SUMS

// Cells of an image, with index (slice * tiles.y + tile y) * tiles.x + tile x. Lists contain local lights
// (point, spot, area); directional lights affect every pixel. Light indices in lists start at the first
// local light.
struct LightGrid {
    uvec2 tiles;      // across, down; the last column and row may be partial
    uint tile_shift;  // a tile is 1 << tile_shift pixels wide and high
    uint slices;      // of depth; 1 if tiled
    // slice = (bits of (depth + slice_offset) - bits of slice_offset) >> slice_shift, at most slices - 1.
    // Integer operations on float bits are exact; slices grow with depth as with a logarithm.
    float slice_offset;  // m
    uint slice_shift;
    uint lists;        // one per cell: tiles.x * tiles.y * slices; with lights_in_front the tiles have a
                       // second set after it, for blended surfaces: from the viewer on
    uint list_stride;  // lists per row of the masks: a multiple of four
    uint local_lights;
    uint first_local;    // index of the first local light: the number of directional lights
    uint point_end;      // end of the point lights' indices
    uint spot_end;       // end of the spots' indices
    uint words;          // of 32 lights each, in a list's mask
    uint segments;       // number of segments, of SEGMENT_WORDS words each, in which a list is counted and
                         // written
    uint width;          // lights per list entry: 1 or 4; lists consist of whole entries;
                         // FEATURE_list_width
    uint null_light;     // pads the last entry of each light type
    uint capacity;       // entries in the index buffer
    uint all_point_end;  // the list of all local lights begins at entry 0; ends of its light types
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

// Conservative bound of a light's range of influence, for culling alone: the intersection of a sphere and
// a cone. View axes from the camera: x right, y down, z forward; m. Enlarged by more than float32
// rounding. Shaders read it as texels.
struct LightBound {
    vec3 centre;
    float radius;    // at most MAX_BOUND_RADIUS; a sphere of that radius is centred at the camera and
                     // contains everything
    vec3 apex;       // of the cone: the light's position
    float cos_cone;  // of half the opening angle; -1: all directions
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

// Number of lights in one segment of a list: all, points, and points plus spots.
struct LightListCount {
    uint all, points, points_and_spots;
    uint begin;  // in a list's first segment: entries of the preceding lists in its group of four
};

// A list: entries [begin, end) of the index buffer in light order; points end at point_end, spots at
// spot_end. Each light type that the scene has takes at least one entry. A list that overflowed is the
// list of all local lights, which begins at 0. Shaders read one texel.
struct LightListHead {
    uint begin, point_end, spot_end, end;
};
#define LIGHT_LIST_HEAD_OF_TEXEL(a) LightListHead(a.x, a.y, a.z, a.w)
CONTRACT_LANE(LightListHead, begin, 0, 0);
CONTRACT_LANE(LightListHead, point_end, 0, 1);
CONTRACT_LANE(LightListHead, spot_end, 0, 2);
CONTRACT_LANE(LightListHead, end, 0, 3);
CONTRACT_TEXELS(LightListHead, 1);

CONTRACT_CONST(uint, LIGHT_TILE, 16);       // pixels; side of a tile with tiled lists: 64 threads handle
                                            // four pixels each
CONTRACT_CONST(uint, SEGMENT_WORDS, 1024);  // 32,768 lights: a loop over them stays below lavapipe's limit
CONTRACT_CONST(uint, LIST_GROUP, 256);      // threads per workgroup of the prefix sum
CONTRACT_CONST(uint, LIGHT_THREADS, 8);     // threads that share the cells of one light
CONTRACT_CONST(float, MAX_BOUND_RADIUS,
               4e18f);  // m, more than twice the largest coordinate; its square stays finite

CONTRACT_END

// SET_LISTS, of the compute shaders that build lists; columns as in bindings.h.
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
LIST_BINDINGS(CONTRACT_BINDING)
CONTRACT_END

#endif
