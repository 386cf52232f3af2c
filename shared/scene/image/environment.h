// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Reads a lat-long picture into the layout of scene.h. OpenEXR, Radiance HDR and PFM are told apart by
// content. Takes the layer R, G, B, or else the first layer that has these three channels. Adds to `notes`:
// that another layer was taken, that the picture's shape is not 2:1, that components which are negative or
// not finite became 0, and those above 65504, which no half holds, 65504. Throws std::runtime_error, one line
// naming file and fault, also for a picture of display colours (PNG, JPEG).
Environment readEnvironment(const std::filesystem::path& file, std::vector<std::string>& notes);

// Components above 65504 become that; a note that begins with `where` counts the pixels. The image has three
// components.
void limitRadiance(Image& radiance, const std::string& where, std::vector<std::string>& notes);

}  // namespace diptych
