// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Decodes all compressed geometry of the model in place, on all cores, so that readers need not know that
// anything was compressed: bufferViews of EXT_meshopt_compression then cover decoded bytes, and primitives
// of KHR_draco_mesh_compression name accessors over decoded bytes, in buffers, bufferViews and accessors
// that are appended. Only meshes that are drawn are decoded (`drawn`: one flag for each mesh); one that fails
// is `broken`, with a note: "mesh 0, primitive 1: KHR_draco_mesh_compression: ...: the mesh is left out". A
// bufferView that fails is noted, and the error is thrown when it is read: "bufferView 3:
// EXT_meshopt_compression: ...". The data is not trusted: the claimed decoded size is checked before memory
// is allocated.
void decompress(tinygltf::Model& model, const std::vector<bool>& drawn,
                std::map<std::size_t, std::string>& broken, std::vector<std::string>& notes);

}  // namespace diptych::gltf
