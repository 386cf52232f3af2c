// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_GEOMETRY_H
#define DIPTYCH_CONTRACT_GEOMETRY_H

#include "types.h"

CONTRACT_BEGIN

// What a vertex carries beside its position (which has a buffer of its own: a depth pass reads no more).
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

// Push constants of a draw.
struct DrawConstants {
    uint draw;         // into the draws
    uint material;     // its number: the channel material_id
    uint light_first;  // with FEATURE_light_batch: the packets of each list that this draw walks, counted
                       // from the
    uint light_end;    // list's begin: [light_first, light_end)
};

CONTRACT_END

#endif
