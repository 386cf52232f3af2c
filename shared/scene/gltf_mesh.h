// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Every mesh in the file's order, on all cores: triangles with normals and tangents. What draws nothing
// (points, lines, no triangle) is left out, with a note. `materials` are the scene's; a primitive without one
// gets the last.
std::vector<Mesh> readMeshes(const tinygltf::Model& model, const std::vector<Material>& materials,
                             std::vector<std::string>& notes);

}  // namespace diptych::gltf
