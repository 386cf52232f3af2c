// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Tangents of a morphed surface as in MikkTSpace (M. Mikkelsen, "Simulation of Wrinkled Surfaces
// Revisited", 2008, section 3): the angle-weighted mean, over a group's corners, of the derivative of
// position by s in the plane of the vertex normal. Groups are those of the rest pose. One thread per
// group.
#include "shaders/lib/math/angles.glsl"
#include "shaders/lib/geometry/posing_thread.glsl"

vec3 inPlaneOf(const vec3 normal, const vec3 v) { return unitVector(v - normal * dot(normal, v)); }

// Differences of the normal map's coordinates: t grows towards the top of the image, v towards the bottom.
vec2 mapped(const PosedInstance i, const vec2 uv) { return vec2(dot(i.map_u, uv), -dot(i.map_v, uv)); }

// Tangent at a corner, weighted by its angle.
vec3 tangentAt(const PosedInstance i, const uint corner) {
    UintArray indices = UintArray(i.indices);
    MorphedArray morphed = MorphedArray(i.morphed);
    uint triangle = corner / 3 * 3, at = corner - triangle;
    MorphedVertex a = morphed.at[indices.at[corner]];
    MorphedVertex b = morphed.at[indices.at[triangle + (at + 1) % 3]];
    MorphedVertex c = morphed.at[indices.at[triangle + (at + 2) % 3]];
    // Uses the two edges that follow from the corner where the shortest edge begins. Differences of
    // products of long edges would cancel for a thin triangle. `area` is twice the signed area in texture
    // space, and `along` the direction of the derivative times it.
    vec3 ab = b.position - a.position, bc = c.position - b.position, ca = a.position - c.position;
    vec2 tab = mapped(i, b.texcoord - a.texcoord), tbc = mapped(i, c.texcoord - b.texcoord);
    vec2 tca = mapped(i, a.texcoord - c.texcoord);
    float ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
    vec3 p = ab, q = bc;
    vec2 tp = tab, tq = tbc;
    if (bc2 < min(ab2, ca2)) p = bc, q = ca, tp = tbc, tq = tca;
    if (ca2 < min(ab2, bc2)) p = ca, q = ab, tp = tca, tq = tab;
    float area = tp.x * tq.y - tp.y * tq.x;
    vec3 normal = unitVector(a.normal);
    vec3 toB = unitVector(ab), toC = unitVector(-ca);
    vec3 along = unitVector(p * tq.y - q * tp.y);
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
