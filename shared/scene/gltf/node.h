// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace tinygltf {
class Node;
}

namespace diptych::gltf {

struct Model;

// Reads the nodes of one scene in the file's order, each with at most one parent and without cycles. Reads
// their lights in node order, then those of the scene's extras; and their cameras in the file's order.
// `chosen`: from chooseScene(). Returns for each node of the file its index in Scene::nodes, -1: not in
// the scene.
std::vector<int> readNodes(const Model& model, int chosen, Scene& scene);

// The parts of a node's transform; rotation 0 0 0 0 counts as none.
Transform partsOf(const tinygltf::Node& node);

// Index of the requested scene, given by index or name, or else of the file's default. -1: the file has no
// scenes.
int chooseScene(const Model& model, const std::string& choice, std::vector<std::string>& notes);

}  // namespace diptych::gltf
