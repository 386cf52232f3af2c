// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/model/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// The nodes of one scene in the file's order, each with one parent and in no circle, and the lights and
// cameras that hang there: lights in node order, then those of the scene's extras, cameras in the file's
// order. `choice` is the scene's index or name; empty: the file's default. Returns each of the file's nodes'
// place in Scene::nodes, -1: not there.
std::vector<int> readNodes(const tinygltf::Model& model, const LightExtras& extras, const std::string& choice,
                           Scene& scene);

}  // namespace diptych::gltf
