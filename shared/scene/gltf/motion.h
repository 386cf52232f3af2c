// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Skins, animations, and what nodes need for them: Node::skin, transform and weights. `sceneNode[n]` is the
// place of the file's node n in Scene::nodes, -1 where the scene does not hold it.
//
// A skin that something is drawn with must be right: every joint in the scene, inverse bind matrices finite
// and affine. Throws std::runtime_error, "skin 0: ...", where it is not. Of an animation, what moves nodes
// outside the scene counts nothing, and a channel with a fault is left out with a note.
void readMotion(const tinygltf::Model& model, const std::vector<int>& sceneNode, Scene& scene);

}  // namespace diptych::gltf
