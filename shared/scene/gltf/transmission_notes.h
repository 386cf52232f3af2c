// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <tiny_gltf.h>

#include <vector>

namespace diptych::gltf {

// Notes once per scene which materials' extensions of transmitted light have no effect, or less than the
// file asks for. `drawn`: by material.
void noteTransmission(const tinygltf::Model& model, const std::vector<bool>& drawn, Scene& scene);

}  // namespace diptych::gltf
