// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_GEOMETRY_H
#define DIPTYCH_CONTRACT_GEOMETRY_H

#include "transparency.h"
#include "types.h"

CONTRACT_BEGIN

// Vertex attributes except the position. Positions have a buffer of their own because depth passes read
// nothing else.
struct VertexAttributes {
    vec3 normal;  // object, unit
    // object; w: sign of the bitangent, times 1 + the turn to the tangent of FEATURE_turned_maps (0 to 1 for
    // a full turn, by the length along the square around it), + 1 if their bitangents have opposite signs
    vec4 tangent;
    vec2 texcoord0;
    vec2 texcoord1;
    vec4 color;  // linear Rec.709, alpha
};

// One draw of one primitive: per-instance attributes at the locations after the vertex's. lavapipe fetches
// instance attributes once per draw, but reads a buffer again for each vertex.
struct Draw {
    mat4 clip_from_object;     // multiplied in double, rounded once
    mat4x3 world_from_object;  // world axes, camera as origin, m: subtracted in double
    mat3 normal_from_object;   // inverse transpose of the linear part, scaled to keep lengths near 1
    float handedness;          // -1 if the transform mirrors, else 1; shares a location with the preceding
                               // column
};

// Push constants of a draw. FEATURE_light_batch: the draw evaluates entries [light_first, light_end) of
// each list, counted from the list's begin.
struct DrawConstants {
    uint draw;      // index into the draws, with FEATURE_object_lights; else 0
    uint material;  // material index: the channel material_id
    uint light_first;
    uint light_end;
    // Blended draws: index of the draw's first triangle among the triangles of all blended surfaces, in
    // scene order.
    uint triangle;
    uint group;    // sample group that a draw of deferred lighting shades: samples.h
    uvec2 posing;  // address of a PosedInstance, with FEATURE_vertex_posing
    float scale;   // world units per object unit, with FEATURE_transmission or _absorbing; else 0
    // Deferred lighting with FEATURE_lighting_tiles.
    uvec2 tiles;     // address of uint[]: the tiles that the draw or dispatch shades, x | y << 16
    vec2 tile_size;  // of a tile in clip space, for draws
    BlendedConstants blended;
};

CONTRACT_END

#endif
