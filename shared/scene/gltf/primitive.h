// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tinygltf {
struct Primitive;
}

namespace diptych::gltf {

struct Model;

struct PrimitiveUse {
    const std::vector<Material>& materials;         // the scene's; the last is the default material
    const std::vector<bool>& anisotropic;           // by material: materialsWithAnisotropy()
    const std::vector<bool>& maps_that_turn;        // by material: tangentMapsThatTurn()
    const std::vector<bool>& layer_maps_that_turn;  // by material: layerMapsThatTurn()
    // Joint count of the smallest skin that uses it; 0: not skinned, ignores joints.
    std::size_t joints = 0;
    std::size_t targets = 0;  // number of morph targets of its mesh
};

// Reads a primitive of the file as triangles with normals and tangents. Omits vertices that no triangle
// uses, and triangles whose positions are not finite or exceed `maxCoordinate`; it is an error if none
// remains. A primitive without triangles has no indices. `who` names the primitive in messages; `notes`
// receives deviations from the file. Throws std::runtime_error.
Primitive readPrimitive(const Model& model, const tinygltf::Primitive& file, const std::string& who,
                        const PrimitiveUse& use, std::vector<std::string>& notes);

// Upper bound of the memory of readPrimitive()'s result, bytes. Also checks the primitive's accessors.
std::size_t decodedBytes(const Model& model, const tinygltf::Primitive& file, const std::string& who);

}  // namespace diptych::gltf
