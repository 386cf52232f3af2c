// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych::gltf {

// Reads Scene::animations, and gives the nodes that they move their Node::transform. `sceneNode` as for
// readMotion(). Channels that move nothing of the scene are ignored, and one with a fault is left out with a
// note. Keys at one time are a step: the last of them counts from that time on, which is noted.
void readAnimations(const tinygltf::Model& model, const std::vector<int>& sceneNode, MotionBudget& budget,
                    Scene& scene);

}  // namespace diptych::gltf
