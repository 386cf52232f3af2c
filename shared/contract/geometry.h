// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_GEOMETRY_H
#define DIPTYCH_CONTRACT_GEOMETRY_H

#include "transparency.h"
#include "types.h"

CONTRACT_BEGIN

// The attributes of a vertex beside its position, which has a buffer of its own because depth passes read
// nothing else.
struct VertexAttributes {
    vec3 normal;   // object, unit
    vec4 tangent;  // object; w: sign of the bitangent
    vec2 texcoord0;
    vec2 texcoord1;
    vec4 color;  // linear Rec.709, alpha
};

// One draw of one primitive: attributes of its instance, at the locations after a vertex's. lavapipe fetches
// those once for all vertices, and what is in a buffer for each of them.
struct Draw {
    mat4 clip_from_object;     // the product in double, rounded once
    mat4x3 world_from_object;  // world axes, camera as origin, m: subtracted in double
    mat3 normal_from_object;   // inverse transpose of the linear part, scaled to keep lengths near 1
    float handedness;          // -1 where the transform mirrors, else 1; read with the last column before it
};

// Push constants of a draw. With FEATURE_light_batch it walks the packets [light_first, light_end) of each
// list, counted from the list's begin.
struct DrawConstants {
    uint draw;      // into the draws, with FEATURE_object_lights; else 0
    uint material;  // its number: the channel material_id
    uint light_first;
    uint light_end;
    // Of blended draws: the number of the draw's first triangle among those of all blended surfaces, in the
    // scene's order.
    uint triangle;
    uint group;    // of samples, that a draw of deferred lighting shades: samples.h
    uvec2 posing;  // address of a PosedInstance, with FEATURE_vertex_posing
    BlendedConstants blended;
};

CONTRACT_END

#endif
