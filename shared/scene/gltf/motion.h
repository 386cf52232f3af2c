// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych::gltf {

struct Model;

// Reads skins, instances and animations, and sets Node::skin, transform, weights and copies.
// `sceneNode[n]` is the index in Scene::nodes of the file's node n, -1 if it is not in the scene. Lights
// and cameras must already be read.
//
// A skin of a drawn mesh must be valid: every joint in the scene, inverse bind matrices finite and affine.
// Otherwise throws std::runtime_error, "skin 0: ...". Channels of nodes outside the scene are ignored;
// faulty channels are omitted with a note.
void readMotion(const Model& model, const std::vector<int>& sceneNode, Scene& scene);

}  // namespace diptych::gltf
