// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Writes the morphed inputs of tangents, for an instance with recomputed tangents; one thread per vertex.
#include "shaders/lib/geometry/posing_thread.glsl"

void main() {
    PosedInstance i = instanceOfDispatch();
    uint vertex = posingThread();
    if (vertex >= i.vertices) return;
    vec2 uv = i.map_second != 0 ? morphedTexcoord1(i, vertex) : morphedTexcoord0(i, vertex);
    MorphedVertex morphed;
    morphed.position = morphedPosition(i, vertex);
    morphed.normal = morphedSurfaceNormal(i, vertex);
    morphed.texcoord = uv;
    MorphedArray(i.morphed).at[vertex] = morphed;
}
