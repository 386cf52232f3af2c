// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace diptych::gltf {

struct PrimitiveUse {
    const std::vector<Material>& materials;   // the scene's; the last is used where a primitive names none
    const std::vector<bool>& maps_that_turn;  // by material: normalMapsThatTurn()
    std::size_t joints = 0;   // of the smallest skin that moves it; 0: not skinned, joints are not read
    std::size_t targets = 0;  // number of morph targets of every primitive of its mesh
};

// Reads a primitive of the file as triangles with normals and tangents. Vertices that no triangle uses are
// left out, as are triangles with a vertex whose position is not finite or beyond `maxCoordinate`. If
// nothing remains to be drawn, the result has no indices. `who` names the primitive in messages; `notes`
// gets what was read otherwise than as the file says. Throws std::runtime_error.
Primitive readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& file, const std::string& who,
                        const PrimitiveUse& use, std::vector<std::string>& notes);

// An upper bound of the memory of readPrimitive()'s result, bytes. Also checks the primitive's accessors.
std::size_t decodedBytes(const tinygltf::Model& model, const tinygltf::Primitive& file,
                         const std::string& who);

}  // namespace diptych::gltf
