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
    const std::vector<Material>& materials;  // the scene's; a primitive without one gets the last
    std::size_t joints = 0;   // of the smallest skin that moves it; 0: none does, its joints are not read
    std::size_t targets = 0;  // morph targets that every primitive of its mesh has
};

// A primitive of the file as triangles with normals and tangents. Vertices that no triangle touches are left
// out, and so are triangles that touch a vertex whose position is not finite or beyond `maxCoordinate`.
// Without indices where nothing is to be drawn. `who` is it, `notes` gets what was read otherwise than the
// file says. Throws std::runtime_error.
Primitive readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& file, const std::string& who,
                        const PrimitiveUse& use, std::vector<std::string>& notes);

// What readPrimitive makes takes at most so many bytes. Its accessors are checked on the way.
std::size_t decodedBytes(const tinygltf::Model& model, const tinygltf::Primitive& file,
                         const std::string& who);

}  // namespace diptych::gltf
