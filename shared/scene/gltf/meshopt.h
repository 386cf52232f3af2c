// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/note_list.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;

// A bufferView with EXT_meshopt_compression. Source: Khronos, EXT_meshopt_compression, 2021, "JSON schema
// updates".
struct MeshoptView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };

    std::size_t view;
    std::span<const unsigned char> stream = {};  // long enough for `count` elements
    // Elements, bytes per element; their product is the bufferView's length.
    std::size_t count = 0, stride = 0;
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::string fault = {};  // violated rule of the extension; such a view is not decoded
};

// All compressed bufferViews of the file.
std::vector<MeshoptView> findMeshopt(const Model& model);

// Decodes the views (Model::decoded_views). Decoded indices are not yet checked. A view that cannot be
// decoded is noted, and reading it throws.
void decodeMeshopt(Model& model, std::vector<MeshoptView> views, NoteList& notes);

}  // namespace diptych::gltf
