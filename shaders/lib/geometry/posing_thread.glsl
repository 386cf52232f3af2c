// SPDX-License-Identifier: MIT
// Common part of the compute shaders for skinning and morphing.
#ifndef POSING_THREAD_GLSL
#define POSING_THREAD_GLSL

#include "shaders/lib/geometry/posing.glsl"

layout(local_size_x = POSING_THREADS) in;
layout(push_constant, scalar) uniform PosingBlock { PosingConstants constants; };

bool has(const uint part) { return (feature_posed_parts & part) != 0; }

// Missing parts are constants when the shader is compiled. On lavapipe a loop without rounds costs as much
// as one round, and a branch that is not taken as much as one that is.
PosedInstance instanceOfDispatch() {
    PosedInstance i = PosedInstanceBlock(constants.instance).instance;
    i.positions = constants.positions;
    i.attributes = constants.attributes;
    i.joints = constants.joints;
    i.joint_weights = constants.joint_weights;
    i.matrices = constants.matrices;
    i.deltas = constants.deltas;
    i.posed_positions = constants.posed_positions;
    i.posed_attributes = constants.posed_attributes;
    i.pivot = constants.pivot;
    i.handedness = constants.handedness;
    i.vertices = constants.vertices;
    i.joint_sets = feature_posed_joint_sets;
    i.flat_normals = has(POSED_FLAT) ? 1 : 0;
    i.positions_end = has(POSED_POSITIONS) ? constants.positions_end : 0;
    i.normals_end = has(POSED_NORMALS) ? constants.normals_end : i.positions_end;
    i.tangents_end = has(POSED_TANGENTS) ? constants.tangents_end : i.normals_end;
    i.texcoords0_end = has(POSED_TEXCOORDS0) ? constants.texcoords0_end : i.tangents_end;
    i.texcoords1_end = has(POSED_TEXCOORDS1) ? constants.texcoords1_end : i.texcoords0_end;
    i.colors_end = has(POSED_COLORS) ? constants.colors_end : i.texcoords1_end;
    if (!has(POSED_GROUPS)) i.groups = 0;
    return i;
}

// Linear index of this thread over all workgroups.
uint posingThread() {
    return (gl_WorkGroupID.y * POSING_GROUPS + gl_WorkGroupID.x) * POSING_THREADS + gl_LocalInvocationIndex;
}

#endif
