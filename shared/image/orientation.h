// SPDX-License-Identifier: MIT
// Orientation of stored pixels. Exif 2.3, 4.6.4.A, and TIFF 6.0 number it by the position of the first row
// and column. 1 top left, 2 top right, 3 bottom right, 4 bottom left. 5 to 8 are transposed: left top,
// right top, right bottom, left bottom.
#pragma once

#include "shared/image/image.h"
#include "shared/image/png.h"

#include <cstddef>
#include <span>

namespace diptych {

// The orientation in an Exif block, which is a TIFF file (PNG: eXIf; JPEG: APP1 after "Exif\0\0"). 1 if
// absent or invalid.
int orientationOf(std::span<const std::byte> exif);
// The orientation in the first Exif block of a JPEG or PNG file; 1 if absent.
int orientationOfJpeg(std::span<const std::byte> file);
int orientationOfPng(std::span<const std::byte> file);

// The image as displayed for `orientation`, 1 to 8; 5 to 8 swap width and height.
Image oriented(Image image, int orientation);
Image8 oriented(Image8 image, int orientation);

}  // namespace diptych
