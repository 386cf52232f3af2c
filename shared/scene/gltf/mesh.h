// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

class Tally;

// The meshes that the scene's nodes draw, on all cores: triangles with normals and tangents, joints where a
// skin moves them, morph targets. Places are the file's: a mesh that no node draws has no primitives. What
// draws nothing (points, lines, no triangle) is left out, with a note. The scene has its nodes, skins and
// materials already. Throws std::runtime_error, before anything is decoded if it would be too much
// (gltf_limits.h).
std::vector<Mesh> readMeshes(const tinygltf::Model& model, const Scene& scene,
                             std::vector<std::string>& notes, Tally& tally);

}  // namespace diptych::gltf
