// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cmath>

namespace diptych {

// Rotation from a tangent to that of RotatedMaps::map, from the tangent to the bitangent, as a vertex stores
// it (VertexAttributes::tangent).
struct TangentRotation {
    double cosine = 1, sine = 0;  // unit
    bool mirrored = false;        // the bitangents have opposite signs

    static TangentRotation of(float w);
    float times(float sign) const;  // the stored w
};
inline float signOf(float w) {
    return w < 0 ? -1.0f : 1.0f;
}
// The tangent that `tangent` turns into, with the sign of its bitangent.
glm::vec4 rotatedTangent(const glm::vec3& normal, const glm::vec4& tangent);

// Face normals, which glTF requires if NORMAL is missing. Vertices are split, so each triangle has its
// own. Degenerate triangles get (0, 0, 1).
void makeFlatNormals(Primitive& primitive);

// Computes tangents as MikkTSpace does (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008)
// from positions, normals and the UV set and transform of `map`. Vertices are split where tangents differ.
// Without that UV set, calls makeAnyTangents(). If morph targets affect tangents, or animation changes the
// map's transform (`map_turns`), vertices are also split by their motion, and Primitive::tangent_groups is
// filled. Call it after the targets have been loaded. `turned`: another map, whose tangents are stored as
// rotations of the first map's (TangentRotation).
void makeTangents(Primitive& primitive, const TextureSlot& map, bool map_turns = false,
                  const TextureSlot* turned = nullptr);
// Every vertex gets a unit tangent perpendicular to its normal, sign +1.
void makeAnyTangents(Primitive& primitive);

}  // namespace diptych
