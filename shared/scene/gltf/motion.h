// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Reads skins, instances and animations, and sets Node::skin, transform, weights and copies. `sceneNode[n]`
// is the index in Scene::nodes of the file's node n, -1 if the scene does not contain it. Lights and cameras
// must have been read.
//
// A skin that a drawn mesh uses must be valid: every joint in the scene, inverse bind matrices finite and
// affine; otherwise std::runtime_error is thrown, "skin 0: ...". Animation channels of nodes outside the
// scene are ignored, and a channel with a fault is left out with a note.
void readMotion(const tinygltf::Model& model, const std::vector<int>& sceneNode, Scene& scene);

}  // namespace diptych::gltf
