// SPDX-License-Identifier: MIT
// What moves the vertices of a skinned or morphed instance. Shaders reach its arrays by address, so a scene
// may have any number of them and no other draw has a binding for it.
#ifndef DIPTYCH_CONTRACT_POSING_H
#define DIPTYCH_CONTRACT_POSING_H

#include "types.h"

CONTRACT_BEGIN

// One morph target's part in an attribute.
struct PosedDelta {
    uvec2 deltas;  // address: as many as vertices, of the attribute's type
    float weight;  // not 0
};

// Addresses are the low and the high word, and 0 where there is nothing.
struct PosedInstance {
    uvec2 positions;         // vec3[vertices], object, m
    uvec2 attributes;        // VertexAttributes[vertices]
    uvec2 joints;            // uvec2[joint_sets * vertices], set by set: four numbers of 16 bits
    uvec2 joint_weights;     // vec4[joint_sets * vertices]; a vertex's add up to 1
    uvec2 matrices;          // mat4x3[]: from the object, about `pivot`, to world axes from the box's origin
    uvec2 deltas;            // PosedDelta[colors_end], attribute by attribute
    uvec2 posed_positions;   // vec3[vertices]: of PosedBox::origin, m
    uvec2 posed_attributes;  // VertexAttributes[vertices], normals and tangents along world axes
    vec3 pivot;              // object, m: near the middle, so that float32 has digits to spare
    float handedness;        // -1 where the instance mirrors, else 1
    uint first_vertex;       // gl_VertexIndex of the first one
    uint vertices;
    uint joint_sets;    // 0: the one matrix moves all vertices
    uint flat_normals;  // 1: every triangle has vertices and a normal of its own
    // Where the deltas of each attribute end; those of the next begin there.
    uint positions_end;
    uint normals_end;
    uint tangents_end;
    uint texcoords0_end;
    uint texcoords1_end;
    uint colors_end;
    // Tangents that are made of the morphed vertices: struct TangentGroups. No groups: tangents move as the
    // surface does.
    uint groups;
    float bitangents;  // -1 where an animation has mirrored the normal map, else 1
    uint map_second;   // 1: the normal map is read with the second texture coordinates
    vec2 map_u;        // struct TextureTransform of the normal map, without its offset
    vec2 map_v;
    uvec2 morphed;          // MorphedVertex[vertices]
    uvec2 indices;          // uint[]: three a triangle
    uvec2 group_of_vertex;  // uint[vertices]; `groups`: none
    uvec2 group_first;      // uint[groups + 1]: into group_corners
    uvec2 group_corners;    // uint[]: into indices
    uvec2 group_tangents;   // vec3[groups], object; 0: has no direction
};

// A vertex as tangents are made of it.
struct MorphedVertex {
    vec3 position;  // object, from `pivot`, m
    vec3 normal;    // object, any length
    vec2 texcoord;  // of the normal map, before its transform
};

// Push constants of the kernels: where the instance is, and those of its members that every vertex needs. At
// most 128 bytes, which every device has.
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

// What an instance has, as feature_posed_parts tells the kernels: deltas of these attributes,
CONTRACT_CONST(uint, POSED_POSITIONS, 1);
CONTRACT_CONST(uint, POSED_NORMALS, 2);
CONTRACT_CONST(uint, POSED_TANGENTS, 4);
CONTRACT_CONST(uint, POSED_TEXCOORDS0, 8);
CONTRACT_CONST(uint, POSED_TEXCOORDS1, 16);
CONTRACT_CONST(uint, POSED_COLORS, 32);
CONTRACT_CONST(uint, POSED_FLAT, 64);     // flat_normals
CONTRACT_CONST(uint, POSED_GROUPS, 128);  // tangents that are made of the morphed vertices
CONTRACT_CONST(uint, POSED_PAIRS, 256);   // numbers of 32 bits are loaded in pairs
CONTRACT_CONST(uint, POSED_JOINTS, 512);  // normals by each joint's inverse transpose

// feature_vertex_posing: the normal of a vertex goes by its matrix, or by each joint's inverse transpose.
CONTRACT_CONST(uint, VERTEX_POSING_BLENDED, 1);
CONTRACT_CONST(uint, VERTEX_POSING_JOINTS, 2);

// An inverse transpose is the cofactors over the determinant, of a matrix whose largest component is 1; a
// joint that flattens has neither. Beside others it counts for so much.
CONTRACT_CONST(float, LEAST_DETERMINANT, 1e-30f);
CONTRACT_CONST(float, MOST_INVERSE, 1e18f);

// Positions beyond it are NaN, and their triangles are not drawn; m. maxCoordinate of scene.h.
CONTRACT_CONST(float, MAX_POSED_COORDINATE, 1e18f);

CONTRACT_CONST(uint, POSING_THREADS, 64);
// Workgroups along x; those beyond go along y.
CONTRACT_CONST(uint, POSING_GROUPS, 32768);

CONTRACT_END

#endif
