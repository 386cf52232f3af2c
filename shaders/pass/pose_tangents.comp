// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The tangents of a morphed surface as MikkTSpace makes them (M. Mikkelsen, "Simulation of Wrinkled
// Surfaces Revisited", 2008, section 3): the angle-weighted mean over a group's corners of their triangles'
// derivatives of position by s, in the plane of the vertex normal. The groups are those of the surface at
// rest; a thread each.
#include "shaders/lib/angles.glsl"
#include "shaders/lib/posing_thread.glsl"

vec3 inPlaneOf(vec3 normal, vec3 v) { return unitVector(v - normal * dot(normal, v)); }

// At a corner, times its angle.
vec3 tangentAt(PosedInstance i, uint corner) {
    UintArray indices = UintArray(i.indices);
    MorphedArray morphed = MorphedArray(i.morphed);
    uint triangle = corner / 3 * 3, at = corner - triangle;
    MorphedVertex a = morphed.at[indices.at[corner]];
    MorphedVertex b = morphed.at[indices.at[triangle + (at + 1) % 3]];
    MorphedVertex c = morphed.at[indices.at[triangle + (at + 2) % 3]];
    vec2 tb = b.texcoord - a.texcoord, tc = c.texcoord - a.texcoord;
    float area = tb.x * tc.y - tb.y * tc.x;  // signed, twice
    vec3 normal = unitVector(a.normal);
    vec3 toB = unitVector(b.position - a.position), toC = unitVector(c.position - a.position);
    vec3 along = unitVector((b.position - a.position) * tc.y - (c.position - a.position) * tb.y);
    vec3 u = inPlaneOf(normal, toB), v = inPlaneOf(normal, toC);
    float angle = angleOf(dot(u, v), lengthOf(crossProduct(u, v)));
    return (area > 0.0 ? angle : area < 0.0 ? -angle : 0.0) * inPlaneOf(normal, along);
}

void main() {
    PosedInstance i = instanceOfDispatch();
    uint group = posingThread();
    if (group >= i.groups) return;
    uint end = UintArray(i.group_first).at[group + 1];
    vec3 sum = vec3(0.0);
    for (uint c = UintArray(i.group_first).at[group]; c < end; ++c)
        sum += tangentAt(i, UintArray(i.group_corners).at[c]);
    Vec3Array(i.group_tangents).at[group] = unitVector(sum);
}
