// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/image/header.h"
#include "shared/scene/model/scene.h"

#include <span>

namespace diptych {

// Both functions accept PNG (1 to 16 bits, any colour type, interlaced or not), JPEG (8 bits; grey, colour
// or CMYK, sequential or progressive) and WebP (lossy or lossless, with or without alpha; not animated).
// They throw std::runtime_error without the file's name, such as "is not PNG, JPEG or WebP" or "is GIF;
// only PNG, JPEG and WebP are supported". Each side must be 1 to 16384 pixels, and the file long enough for
// its claimed pixels.
ImageHeader imageHeader(std::span<const unsigned char> encoded);

// The stored pixels: colour profiles and gamma chunks are ignored (glTF 2.0, 3.8.3). Components of up to 8
// bits become 8 bits, 16 bits stay. Prints nothing, even for corrupt files.
TextureImage decodeImage(std::span<const unsigned char> encoded);

}  // namespace diptych
