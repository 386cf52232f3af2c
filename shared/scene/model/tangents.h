// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace diptych {

// Flat normals, which glTF asks for where NORMAL is missing. Vertices are split, so that every triangle has
// vertices of its own. A triangle without area gets (0, 0, 1).
void makeFlatNormals(Primitive& primitive);

// Tangents as MikkTSpace makes them (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008),
// from positions, normals and the coordinates that `map` is read with, its transform included; vertices are
// split where tangents differ. Without its UV set it makes any. Where morph targets move what tangents follow
// from, or `map_turns` over time, vertices are also split by what moves them, and Primitive::tangent_groups
// says how tangents of a pose follow; call it after the targets are there.
void makeTangents(Primitive& primitive, const TextureSlot& map, bool map_turns = false);
// Every vertex gets a unit tangent perpendicular to its normal, sign +1.
void makeAnyTangents(Primitive& primitive);

}  // namespace diptych
