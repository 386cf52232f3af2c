// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Whether the file begins like a format of linear light: OpenEXR, Radiance HDR or PFM.
bool isRadianceImage(std::span<const std::byte> bytes);

// Three components per pixel, finite and at least 0: the layer R, G, B, or else the first layer with these
// channels. Negative and non-finite components become 0. `notes` gets these changes, the choice of another
// layer and the reader's own notes, each prefixed by `where`. Throws std::runtime_error without the file's
// name if no layer has the three channels.
Image radianceOf(const ImageFile& image, const std::string& where, std::vector<std::string>& notes);

}  // namespace diptych
