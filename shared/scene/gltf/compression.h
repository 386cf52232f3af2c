// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Afterwards nothing in the model is compressed and readers need not know that anything was: bufferViews of
// EXT_meshopt_compression cover decoded bytes, primitives of KHR_draco_mesh_compression name accessors over
// decoded bytes, in buffers, bufferViews and accessors that are appended. On all cores. Of meshes only those
// that are drawn are decoded; the first of them that fails is thrown as std::runtime_error: "mesh 0,
// primitive 1: KHR_draco_mesh_compression: ...". A bufferView that fails is noted, and thrown at whoever
// reads it: "bufferView 3: EXT_meshopt_compression: ...". What is compressed comes from anywhere: how much it
// says it decodes to is checked before memory is taken for it. `drawn`: one flag a mesh.
void decompress(tinygltf::Model& model, const std::vector<bool>& drawn, std::vector<std::string>& notes);

}  // namespace diptych::gltf
