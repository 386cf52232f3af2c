// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych::gltf {

// EXT_mesh_gpu_instancing: where nodes draw their mesh several times; sets Node::copies. `sceneNode` as for
// readMotion(), after skins have been read. Throws std::runtime_error, "node 3: ...", for faulty attributes.
// A skinned mesh has no transform of its own (glTF 2.0, 3.7.3.3), so that its instances would all lie in one
// place: it is drawn once, with a note. A rotation 0 0 0 0 is none, as for nodes.
void readInstancing(const tinygltf::Model& model, const std::vector<int>& sceneNode, MotionBudget& budget,
                    Scene& scene);

}  // namespace diptych::gltf
