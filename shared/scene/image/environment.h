// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Reads a lat-long image into an Environment. OpenEXR, Radiance HDR and PFM are recognized by content.
// Uses the layer R, G, B, or else the first layer with these three channels. Negative and non-finite
// components become 0; those above 65504, the largest half, become 65504. `notes` gets these changes, the
// choice of another layer, and a shape other than 2:1. Throws std::runtime_error, one line that names file
// and fault; also for PNG and JPEG, which are display-referred.
Environment readEnvironment(const std::filesystem::path& file, std::vector<std::string>& notes);

// Clamps the components of a three-component image to 65504. Adds a note that begins with `where` and
// counts the changed pixels.
void limitRadiance(Image& radiance, const std::string& where, std::vector<std::string>& notes);

}  // namespace diptych
