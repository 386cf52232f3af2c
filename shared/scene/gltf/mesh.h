// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

class Tally;

// Reads the meshes that the scene's nodes draw, on all cores: triangles with normals and tangents, joints
// where a skin moves them, morph targets. Indices are the file's: a mesh that no node draws has no
// primitives. Primitives without triangles (points, lines) are left out with a note. The scene must have its
// nodes, skins and materials already. `broken`: meshes that cannot be read, with the reason. They and
// primitives with a fault are left out, these with a note; where nothing else is drawn, that is an error.
// Throws std::runtime_error; if the decoded size exceeds the limits (limits.h), before anything is decoded.
std::vector<Mesh> readMeshes(const tinygltf::Model& model, const Scene& scene,
                             const std::map<std::size_t, std::string>& broken,
                             std::vector<std::string>& notes, Tally& tally);

}  // namespace diptych::gltf
