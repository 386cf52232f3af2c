// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace diptych {

// Face normals, which glTF requires if NORMAL is missing. Vertices are split, so each triangle has its
// own. Degenerate triangles get (0, 0, 1).
void makeFlatNormals(Primitive& primitive);

// Computes tangents as MikkTSpace does (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008)
// from positions, normals and the UV set and transform of `map`. Vertices are split where tangents differ.
// Without that UV set, calls makeAnyTangents(). If morph targets affect tangents, or animation changes the
// map's transform (`map_turns`), vertices are also split by their motion, and Primitive::tangent_groups is
// filled. Call it after the targets have been loaded.
void makeTangents(Primitive& primitive, const TextureSlot& map, bool map_turns = false);
// Every vertex gets a unit tangent perpendicular to its normal, sign +1.
void makeAnyTangents(Primitive& primitive);

}  // namespace diptych
