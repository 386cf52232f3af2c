// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// The nodes of the default scene in the file's order, each with one parent and in no circle, and the lights
// and cameras that hang there: lights in node order, cameras in the file's order.
void readNodes(const tinygltf::Model& model, Scene& scene);

}  // namespace diptych::gltf
