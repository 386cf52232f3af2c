// SPDX-License-Identifier: MIT
// How stored pixels are turned to be shown. Exif 2.3, 4.6.4.A, and TIFF 6.0 number the ways 1 to 8 by the
// place of the first row and column: 1 top left, 2 top right, 3 bottom right, 4 bottom left, and 5 to 8 the
// same with rows and columns exchanged: left top, right top, right bottom, left bottom.
#pragma once

#include "shared/image/image.h"
#include "shared/image/png.h"

#include <cstddef>
#include <span>

namespace diptych {

// What an Exif block says (it is a TIFF file; PNG's eXIf, JPEG's APP1 behind "Exif\0\0"); 1 where it says
// nothing, or what is no orientation.
int orientationOf(std::span<const std::byte> exif);
// The same of a JPEG's first Exif block, and of a PNG's.
int orientationOfJpeg(std::span<const std::byte> file);
int orientationOfPng(std::span<const std::byte> file);

// `orientation`: 1 to 8.
Image turned(Image image, int orientation);
Image8 turned(Image8 image, int orientation);

}  // namespace diptych
