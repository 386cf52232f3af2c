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

// The orientation in an Exif block, which is a TIFF file (PNG's eXIf; JPEG's APP1 behind "Exif\0\0"). 1 where
// there is none, or a number that is none.
int orientationOf(std::span<const std::byte> exif);
// The orientation in the first Exif block of a JPEG or PNG file; 1 where there is none.
int orientationOfJpeg(std::span<const std::byte> file);
int orientationOfPng(std::span<const std::byte> file);

// The image as `orientation`, 1 to 8, has it shown: 5 to 8 exchange width and height.
Image turned(Image image, int orientation);
Image8 turned(Image8 image, int orientation);

}  // namespace diptych
