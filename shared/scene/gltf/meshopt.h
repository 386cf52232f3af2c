// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/value.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych::gltf {

// A bufferView of EXT_meshopt_compression. Source: Khronos, EXT_meshopt_compression, 2021, "JSON schema
// updates".
struct MeshoptView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };

    std::size_t view;
    std::span<const unsigned char> stream = {};  // long enough to hold `count` elements
    std::size_t count = 0, stride = 0;           // elements, bytes: their product is the bufferView's length
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::string fault = {};  // which rule of the extension it breaks; then there is nothing to decode
};

// All that the file has.
std::vector<MeshoptView> findMeshopt(const tinygltf::Model& model);

// Gives every one of them a buffer of decoded bytes. Decoded indices may still be any number. What cannot be
// decoded is noted, and its fault is thrown at whoever reads it (missing, gltf_value.h).
void decodeMeshopt(tinygltf::Model& model, std::vector<MeshoptView> views, NoteList& notes);

}  // namespace diptych::gltf
