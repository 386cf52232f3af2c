// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych::gltf {

// EXT_mesh_gpu_instancing: sets Node::copies. `sceneNode` as for readMotion(); call it after skins have
// been read. Throws std::runtime_error, "node 3: ...", for faulty attributes. A skinned mesh is drawn
// once, with a note: it ignores node transforms (glTF 2.0, 3.7.3.3), so its instances would coincide. A
// rotation 0 0 0 0 means none, as for nodes.
void readInstancing(const Model& model, const std::vector<int>& sceneNode, MotionBudget& budget,
                    Scene& scene);

}  // namespace diptych::gltf
