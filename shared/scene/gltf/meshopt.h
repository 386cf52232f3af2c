// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/value.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych::gltf {

// A bufferView with EXT_meshopt_compression. Source: Khronos, EXT_meshopt_compression, 2021, "JSON schema
// updates".
struct MeshoptView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };

    std::size_t view;
    std::span<const unsigned char> stream = {};  // long enough to hold `count` elements
    std::size_t count = 0, stride = 0;  // elements, bytes each; their product is the bufferView's length
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::string fault = {};  // the rule of the extension that it breaks: it is not decoded then
};

// All such bufferViews of the file.
std::vector<MeshoptView> findMeshopt(const tinygltf::Model& model);

// Gives each view a buffer of decoded bytes. Decoded indices may still have any value. A view that cannot be
// decoded is noted, and the error is thrown when it is read (missing(), value.h).
void decodeMeshopt(tinygltf::Model& model, std::vector<MeshoptView> views, NoteList& notes);

}  // namespace diptych::gltf
