// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/picture_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Whether a file's first bytes are those of a picture of linear light: OpenEXR, Radiance HDR or PFM.
bool isRadiancePicture(std::span<const std::byte> bytes);

// Three components a pixel, finite and at least 0: the layer R, G, B, or else the first that has these three.
// What is added to `notes`, each with `where` before it: what the reader noted, another layer, components
// that are negative or not finite, which become 0. Throws std::runtime_error, without a name, where no layer
// has them.
Image radianceOf(const PictureFile& picture, const std::string& where, std::vector<std::string>& notes);

}  // namespace diptych
