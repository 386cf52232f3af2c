// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/picture_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Whether the first bytes are those of a format of linear light: OpenEXR, Radiance HDR or PFM.
bool isRadiancePicture(std::span<const std::byte> bytes);

// Three components a pixel, finite and at least 0: the layer R, G, B, or else the first layer that has these
// three channels. Adds to `notes`, each prefixed by `where`: the reader's own notes, that another layer was
// taken, that components which are negative or not finite became 0. Throws std::runtime_error, without the
// file's name, if no layer has the three channels.
Image radianceOf(const PictureFile& picture, const std::string& where, std::vector<std::string>& notes);

}  // namespace diptych
