// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/image/header.h"
#include "shared/scene/model/scene.h"

#include <span>

namespace diptych {

// Both functions take a PNG (1 to 16 bits, grey, palette or colour, any transparency, interlaced or not) or
// a JPEG (8 bits; grey, colour or CMYK, sequential or progressive), and throw std::runtime_error without the
// file's name: "is not PNG or JPEG", "is WebP; only PNG and JPEG are supported", "does not decode: bad
// adaptive filter value". A header is refused if a side is not within 1 to 16384 pixels, or if the file is
// too short for as many pixels as the header claims.
ImageHeader imageHeader(std::span<const unsigned char> encoded);

// The pixels as they are stored: colour profiles and gamma chunks are ignored, as glTF 2.0 (3.8.3) asks.
// Components of up to 8 bits become 8 bits, those of 16 stay 16. Nothing is printed, whatever the file
// holds.
TextureImage decodeImage(std::span<const unsigned char> encoded);

}  // namespace diptych
