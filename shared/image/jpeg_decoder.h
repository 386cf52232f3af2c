// SPDX-License-Identifier: MIT
// The only place that reads JPEG files with libjpeg, for pictures and textures: 8 bits; grey, colour or CMYK,
// sequential or progressive. Nothing is printed, whatever the file holds.
#pragma once

#include <cstdint>
#include <span>

namespace diptych {

struct JpegSize {
    std::int64_t width = 0, height = 0;
    bool grey = false;
};

// An 8 x 8 block takes at least one bit, and sampling factors of 4x1, 1x4 and 1x1 spread nine blocks over
// 32 x 32 pixels: at most 910 pixels a byte.
inline constexpr std::int64_t jpeg_pixels_per_byte = 1024;

// Both take a file whose signature (ff d8 ff) has been checked, and throw std::runtime_error without the
// file's name. The second fills `pixels`: size.height rows of RGBA, 8 bits, opaque, row 0 on top.
JpegSize readJpegSize(std::span<const unsigned char> encoded);
void readJpegRgba(std::span<const unsigned char> encoded, const JpegSize& size, unsigned char* pixels);

}  // namespace diptych
