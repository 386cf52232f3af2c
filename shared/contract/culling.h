// SPDX-License-Identifier: MIT
// How a device chooses the triangles of a view that may show, into indirect draws (shared/draw/README.md,
// "What cannot show"). The kernel reaches all arrays by address.
#ifndef DIPTYCH_CONTRACT_CULLING_H
#define DIPTYCH_CONTRACT_CULLING_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, CULLED_TRIANGLES, 64);  // of a cluster, at most
CONTRACT_CONST(uint, CULLED_CLUSTERS, 64);   // of a part, at most

// A thread a triangle, of so many clusters at a time.
CONTRACT_CONST(uint, CULLING_THREADS, 256);
// Workgroups along x; those beyond go along y.
CONTRACT_CONST(uint, CULLING_GROUPS, 32768);

struct CulledCluster {
    vec3 min;  // object, m: the box of its corners
    uint first_index;
    vec3 max;
    uint triangles;
};

// What an instance's draw shows of a triangle.
CONTRACT_CONST(uint, CULLED_BOTH_SIDES, 1);
CONTRACT_CONST(uint, CULLED_MIRRORED, 2);  // fronts are clockwise on the screen

// One instance.
struct CulledItem {
    mat4 clip_from_object;  // of its draw
    vec4 error;             // clip, by component: how far two shaders' products for one corner lie apart
    uint first_vertex;
    uint draw;   // the instance that its draws begin at
    uint sides;  // CULLED_*, a sum
};

// Clusters of one instance that follow one another from near to far: a workgroup chooses of them, and an
// indirect draw draws what it has chosen.
struct CulledPart {
    uint item;
    uint first;  // into the order of clusters
    uint clusters;
    uint place;    // of its first chosen index
    uint command;  // of its draw
};

// VkDrawIndexedIndirectCommand.
struct IndirectDraw {
    uint index_count;
    uint instances;
    uint first_index;
    uint first_vertex;
    uint first_instance;
};

// Push constants. Addresses are the low and the high word.
struct CullingConstants {
    uvec2 positions;  // vec3[], object, m
    uvec2 indices;    // uint[]: three a triangle, from CulledItem::first_vertex on
    uvec2 clusters;   // CulledCluster[]
    uvec2 items;      // CulledItem[]
    uvec2 parts;      // CulledPart[part_count]
    uvec2 order;      // uint[]: numbers of clusters
    uvec2 chosen;     // uint[]: the indices of what may show
    uvec2 draws;      // IndirectDraw[]
    uint part_count;
    uint samples;     // of a pixel: 1, 4 or 8
    vec2 half_size;   // of the picture, pixels
    float place_off;  // pixels: how far two devices' places of one corner lie apart, clip space aside
    float snap;       // pixels: how far a rasteriser moves a corner, at most
};

CONTRACT_END

#endif
