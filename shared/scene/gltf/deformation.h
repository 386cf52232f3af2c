// SPDX-License-Identifier: MIT
// What moves the vertices of a primitive: joints and morph targets (glTF 2.0, 3.7.3.3 and 3.7.2.2).
#pragma once

#include "shared/scene/gltf/attributes.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych::gltf {

// Reads JOINTS_n with WEIGHTS_n for n = 0, 1, ... as long as they are present. Weights are made to add up to
// 1. `joints`: of the smallest skin that moves the primitive; `vertices`: the kept vertices' numbers in the
// file, for messages. Throws std::runtime_error.
void readJointSets(const AttributeReader& reader, std::size_t joints, std::span<const std::uint32_t> vertices,
                   Primitive& primitive);

// Reads the morph targets, `count` of which every primitive of the mesh has: deltas of POSITION, NORMAL,
// TANGENT, TEXCOORD_0, TEXCOORD_1 and COLOR_0, as far as the primitive has these attributes itself. Other
// deltas are left out with a note. Throws std::runtime_error.
void readTargets(const AttributeReader& reader, std::size_t count, Primitive& primitive);

}  // namespace diptych::gltf
