// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;

// Decodes all compressed geometry of the model in place, on all cores; later readers see plain accessors.
// EXT_meshopt_compression: bufferViews then have decoded bytes. KHR_draco_mesh_compression: primitives then
// name appended accessors, which have decoded elements. Only drawn meshes are decoded (`drawn`: one flag
// per mesh). A mesh that fails becomes `broken`, with a note: "mesh 0, primitive 1:
// KHR_draco_mesh_compression: ...: the mesh is left out". A bufferView that fails is noted, and reading it
// throws: "bufferView 3: EXT_meshopt_compression: ...". Decoded sizes are checked before memory is
// allocated.
void decompress(Model& model, const std::vector<bool>& drawn, std::map<std::size_t, std::string>& broken,
                std::vector<std::string>& notes);

}  // namespace diptych::gltf
