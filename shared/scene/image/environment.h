// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// A lat-long picture as it lies in scene.h, from OpenEXR, Radiance HDR or PFM, told by content: the layer R,
// G, B, or else the first that has these three. What is added to `notes`: another layer, another shape than
// 2:1, components that are negative or not finite, which become 0. Throws std::runtime_error, one line naming
// file and fault; a picture of display colours is one.
Environment readEnvironment(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace diptych
