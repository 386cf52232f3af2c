// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deforms the vertices of an instance into the buffers that draws read, one thread per vertex.
#include "shaders/lib/geometry/posing_thread.glsl"

void main() {
    PosedInstance i = instanceOfDispatch();
    uint vertex = posingThread();
    if (vertex >= i.vertices) return;
    PosedVertex posed = posedVertex(i, vertex, has(POSED_JOINTS));
    AttributesArray attributes = AttributesArray(i.posed_attributes);
    Vec3Array(i.posed_positions).at[vertex] = posed.position;
    attributes.at[vertex].normal = posed.normal;
    attributes.at[vertex].tangent.xyz = posed.tangent;
    if (i.groups > 0)
        attributes.at[vertex].tangent.w =
            i.bitangents * AttributesArray(i.attributes).at[vertex].tangent.w;
    // Attributes that no morph target changes are already there.
    if (has(POSED_TEXCOORDS0)) attributes.at[vertex].texcoord0 = morphedTexcoord0(i, vertex);
    if (has(POSED_TEXCOORDS1)) attributes.at[vertex].texcoord1 = morphedTexcoord1(i, vertex);
    if (has(POSED_COLORS)) attributes.at[vertex].color = morphedColor(i, vertex);
}
