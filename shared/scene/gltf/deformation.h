// SPDX-License-Identifier: MIT
// Reads joints and morph targets of a primitive (glTF 2.0, 3.7.3.3 and 3.7.2.2).
#pragma once

#include "shared/scene/gltf/attributes.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych::gltf {

// Reads JOINTS_n and WEIGHTS_n for n = 0, 1, ... while present, and normalizes the weights. `joints`:
// joint count of the smallest skin that uses the primitive. `vertices`: file indices of the kept vertices,
// for messages. Throws std::runtime_error.
void readJointSets(const AttributeReader& reader, std::size_t joints, std::span<const std::uint32_t> vertices,
                   Primitive& primitive);

// Reads the morph targets; every primitive of the mesh has `count`. Reads deltas of POSITION, NORMAL,
// TANGENT, TEXCOORD_0, TEXCOORD_1 and COLOR_0 if the primitive has that attribute; omits others with a
// note. Throws std::runtime_error.
void readTargets(const AttributeReader& reader, std::size_t count, Primitive& primitive);

}  // namespace diptych::gltf
