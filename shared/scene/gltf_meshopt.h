// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf_value.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych::gltf {

// A bufferView of EXT_meshopt_compression that keeps the extension's rules. Source: Khronos,
// EXT_meshopt_compression, 2021, "JSON schema updates".
struct MeshoptView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };

    std::size_t view;
    std::span<const unsigned char> stream;  // long enough to hold `count` elements
    std::size_t count, stride;              // elements, bytes: their product is the bufferView's length
    Mode mode;
    Filter filter;
};

// Throws std::runtime_error at the first that breaks a rule, and where bytes are asked of a fallback buffer
// that has none.
std::vector<MeshoptView> findMeshopt(const tinygltf::Model& model);

// Gives every one of them a buffer of decoded bytes. Decoded indices may still be any number.
void decodeMeshopt(tinygltf::Model& model, const std::vector<MeshoptView>& views);

}  // namespace diptych::gltf
