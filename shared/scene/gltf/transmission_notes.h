// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace diptych::gltf {

// Notes once per scene which materials' extensions of transmitted light have no effect, or less than the
// file asks for. `materials`: the document's. `drawn`: by material.
void noteTransmission(const nlohmann::json& materials, const std::vector<bool>& drawn, Scene& scene);

}  // namespace diptych::gltf
