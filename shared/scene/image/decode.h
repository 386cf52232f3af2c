// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/image/header.h"
#include "shared/scene/model/scene.h"

#include <span>

namespace diptych {

// Both take a PNG (1 to 16 bits, grey, palette or colour, any transparency, interlaced or not) or a JPEG
// (8 bits; grey, colour or CMYK, sequential or progressive), and throw std::runtime_error without a name:
// "is neither PNG nor JPEG", "is WebP; PNG and JPEG are read", "does not decode: bad adaptive filter value".
// A header is refused where a side is beyond 1 to 16384 pixels or the bytes cannot hold as many pixels as it
// claims.
ImageHeader imageHeader(std::span<const unsigned char> encoded);

// Pixels as they are stored: colour profiles and gamma chunks are ignored, as glTF 2.0 (3.8.3) asks. Files of
// up to 8 bits a component become 8, those of 16 stay 16. Nothing is printed, whatever the file holds.
TextureImage decodeImage(std::span<const unsigned char> encoded);

}  // namespace diptych
