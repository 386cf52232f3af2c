// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych::gltf {

// Reads Scene::animations and sets Node::transform of animated nodes. `sceneNode` as for readMotion().
// Ignores channels that affect nothing in the scene; omits faulty ones with a note. If keys have equal
// times, the last one counts from that time on, which is noted.
void readAnimations(const Model& model, const std::vector<int>& sceneNode, MotionBudget& budget,
                    Scene& scene);

}  // namespace diptych::gltf
