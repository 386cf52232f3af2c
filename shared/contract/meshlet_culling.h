// SPDX-License-Identifier: MIT
// GPU culling: selects the triangles of a view that may be visible and writes indirect draws
// (shared/draw/README.md, "What cannot show"). The compute shader reads all arrays by address.
#ifndef DIPTYCH_CONTRACT_MESHLET_CULLING_H
#define DIPTYCH_CONTRACT_MESHLET_CULLING_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, MAX_MESHLET_TRIANGLES, 64);  // largest number of triangles in a meshlet
CONTRACT_CONST(uint, MAX_PART_MESHLETS, 64);      // largest number of meshlets in a part

// One thread per triangle; a workgroup processes this many triangles at a time.
CONTRACT_CONST(uint, CULLING_THREADS, 256);
// Workgroups in x; further ones continue in y.
CONTRACT_CONST(uint, CULLING_GROUPS, 32768);

struct CulledMeshlet {
    vec3 min;  // object space, m: bounding box
    uint first_index;
    vec3 max;
    uint triangles;
};

// Sides of an instance's triangles that are drawn.
CONTRACT_CONST(uint, CULLED_BOTH_SIDES, 1);
CONTRACT_CONST(uint, CULLED_MIRRORED, 2);  // front faces are clockwise on screen

// One instance.
struct CulledItem {
    mat4 clip_from_object;  // that of its draw
    vec4 error;             // clip space, per component: largest difference of two shaders' transforms
                            // of one vertex
    uint first_vertex;
    uint draw;   // firstInstance of its draws
    uint sides;  // sum of CULLED_*
};

// Consecutive meshlets of one instance, near to far. One workgroup culls them and fills one indirect draw.
struct CulledPart {
    uint item;
    uint first;  // index into the order of meshlets
    uint meshlets;
    uint first_index;  // offset of its first visible index
    uint command;      // index of its draw
};

// VkDrawIndexedIndirectCommand.
struct IndirectDraw {
    uint index_count;
    uint instances;
    uint first_index;
    uint first_vertex;
    uint first_instance;
};

// Push constants. An address is (low word, high word).
struct CullingConstants {
    uvec2 positions;        // vec3[], object, m
    uvec2 indices;          // uint[]: three per triangle, relative to CulledItem::first_vertex
    uvec2 meshlets;         // CulledMeshlet[]
    uvec2 items;            // CulledItem[]
    uvec2 parts;            // CulledPart[part_count]
    uvec2 order;            // uint[]: meshlet indices
    uvec2 visible_indices;  // uint[]: vertex indices of the triangles that may be visible
    uvec2 draws;            // IndirectDraw[]
    uint part_count;
    uint samples;          // per pixel: 1, 4 or 8
    vec2 half_size;        // of the image, pixels
    float position_error;  // pixels: largest difference between two devices' positions of one vertex, without
                           // the clip-space error
    float snap;            // pixels: largest distance by which a rasterizer snaps a vertex
};

CONTRACT_END

#endif
