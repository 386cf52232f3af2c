// SPDX-License-Identifier: MIT
// Skinning and morphing of an instance. Shaders access its arrays by address: their number is not limited,
// and other draws need no binding for them.
#ifndef DIPTYCH_CONTRACT_POSING_H
#define DIPTYCH_CONTRACT_POSING_H

#include "types.h"

CONTRACT_BEGIN

// Contribution of one morph target to an attribute.
struct PosedDelta {
    uvec2 deltas;  // address: one per vertex, of the attribute's type
    float weight;  // not 0
};

// An address is (low word, high word); 0: no array.
struct PosedInstance {
    uvec2 positions;         // vec3[vertices], object, m
    uvec2 attributes;        // VertexAttributes[vertices]
    uvec2 joints;            // uvec2[joint_sets * vertices], set by set: four 16-bit joint indices
    uvec2 joint_weights;     // vec4[joint_sets * vertices]; each vertex's sum is 1
    uvec2 matrices;          // mat4x3[]: from object space relative to `pivot` to world axes relative to
                             // the box's origin
    uvec2 deltas;            // PosedDelta[colors_end], attribute by attribute
    uvec2 posed_positions;   // vec3[vertices]: relative to PosedBox::origin, m
    uvec2 posed_attributes;  // VertexAttributes[vertices], normals and tangents along world axes
    vec3 pivot;              // object, m: near the centre, to preserve float32 precision
    float handedness;        // -1 if the instance mirrors, else 1
    uint first_vertex;       // gl_VertexIndex of the first one
    uint vertices;
    uint joint_sets;    // 0: one matrix transforms all vertices
    uint flat_normals;  // 1: every triangle has its own vertices and normal
    // Ends of each attribute's deltas; the next attribute's begin there.
    uint positions_end;
    uint normals_end;
    uint tangents_end;
    uint texcoords0_end;
    uint texcoords1_end;
    uint colors_end;
    // Tangents recomputed from the morphed vertices: struct TangentGroups. 0 groups: tangents transform
    // with the surface.
    uint groups;
    float bitangents;  // -1 if an animation has mirrored the normal map, else 1
    uint map_second;   // 1: the normal map uses the second texture coordinates
    vec2 map_u;        // struct TextureTransform of the normal map, without its offset
    vec2 map_v;
    uvec2 morphed;          // MorphedVertex[vertices]
    uvec2 indices;          // uint[]: three per triangle
    uvec2 group_of_vertex;  // uint[vertices]; the value `groups`: no group
    uvec2 group_first;      // uint[groups + 1]: into group_corners
    uvec2 group_corners;    // uint[]: into indices
    uvec2 group_tangents;   // vec3[groups], object; 0: no direction
};

// Input vertex of recomputed tangents.
struct MorphedVertex {
    vec3 position;  // object, relative to `pivot`, m
    vec3 normal;    // object, not normalized
    vec2 texcoord;  // of the normal map, before its transform
};

// Push constants of the compute shaders: the instance's address and the members that every vertex needs.
// At most 128 bytes, the limit that every device supports.
struct PosingConstants {
    uvec2 instance;  // address of a PosedInstance
    uvec2 positions;
    uvec2 attributes;
    uvec2 joints;
    uvec2 joint_weights;
    uvec2 matrices;
    uvec2 deltas;
    uvec2 posed_positions;
    uvec2 posed_attributes;
    vec3 pivot;
    float handedness;
    uint vertices;
    uint positions_end;
    uint normals_end;
    uint tangents_end;
    uint texcoords0_end;
    uint texcoords1_end;
    uint colors_end;
};

// feature_posed_parts: what an instance has. Deltas of these attributes:
CONTRACT_CONST(uint, POSED_POSITIONS, 1);
CONTRACT_CONST(uint, POSED_NORMALS, 2);
CONTRACT_CONST(uint, POSED_TANGENTS, 4);
CONTRACT_CONST(uint, POSED_TEXCOORDS0, 8);
CONTRACT_CONST(uint, POSED_TEXCOORDS1, 16);
CONTRACT_CONST(uint, POSED_COLORS, 32);
CONTRACT_CONST(uint, POSED_FLAT, 64);     // flat_normals
CONTRACT_CONST(uint, POSED_GROUPS, 128);  // tangents recomputed from the morphed vertices
CONTRACT_CONST(uint, POSED_PAIRS, 256);   // 32-bit values are loaded in pairs
CONTRACT_CONST(uint, POSED_JOINTS, 512);  // normals by each joint's inverse transpose

// feature_vertex_posing: normals use the vertex's blended matrix, or each joint's inverse transpose.
CONTRACT_CONST(uint, VERTEX_POSING_BLENDED, 1);
CONTRACT_CONST(uint, VERTEX_POSING_JOINTS, 2);

// An inverse transpose is the cofactors over the determinant, of a matrix scaled to a largest component of
// 1. A joint that flattens has no inverse: its determinant is raised to MIN_DETERMINANT, and its inverse
// is limited to MAX_INVERSE.
CONTRACT_CONST(float, MIN_DETERMINANT, 1e-30f);
CONTRACT_CONST(float, MAX_INVERSE, 1e18f);

// Positions beyond it are NaN, so their triangles are not drawn; m. Equals maxCoordinate of scene.h.
CONTRACT_CONST(float, MAX_POSED_COORDINATE, 1e18f);

CONTRACT_CONST(uint, POSING_THREADS, 64);
// Workgroups in x; further ones continue in y.
CONTRACT_CONST(uint, POSING_GROUPS, 32768);

CONTRACT_END

#endif
