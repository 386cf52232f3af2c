// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/model/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Reads the nodes of one scene in the file's order, each with at most one parent and without cycles, and the
// lights and cameras attached to them: lights in node order, then those of the scene's extras; cameras in
// the file's order. `choice` is the scene's index or name; empty: the file's default. Returns for each node
// of the file its index in Scene::nodes, -1: not in the scene.
std::vector<int> readNodes(const tinygltf::Model& model, const LightExtras& extras, const std::string& choice,
                           Scene& scene);

}  // namespace diptych::gltf
