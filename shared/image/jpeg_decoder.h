// SPDX-License-Identifier: MIT
// Reads JPEG files by libjpeg, for images and textures: 8 bits; grey, colour or CMYK, sequential or
// progressive. Prints nothing, even for corrupt files. No other code uses libjpeg.
#pragma once

#include <cstdint>
#include <span>

namespace diptych {

struct JpegSize {
    std::int64_t width = 0, height = 0;
    bool grey = false;
};

// Bound: an 8 x 8 block takes at least one bit. Sampling factors of 4x1, 1x4 and 1x1 spread nine blocks
// over 32 x 32 pixels: at most 910 pixels per byte.
inline constexpr std::int64_t jpeg_pixels_per_byte = 1024;

// Both expect a file with the signature ff d8 ff, and throw std::runtime_error without its name.
// readJpegRgba() fills `pixels`: size.height rows of opaque RGBA, 8 bits, row 0 on top.
JpegSize readJpegSize(std::span<const unsigned char> encoded);
void readJpegRgba(std::span<const unsigned char> encoded, const JpegSize& size, unsigned char* pixels);

}  // namespace diptych
