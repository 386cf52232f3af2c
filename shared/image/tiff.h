// SPDX-License-Identifier: MIT
// TIFF 6.0 (Adobe 1992) with the sample formats of its supplements, and BigTIFF. Read by libtiff.
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"
#include "shared/image/primaries.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct TiffImage {
    Image image;              // Y, YA, RGB or RGBA, row 0 on top
    std::string sample;       // "8 bit", "16 bit", "32 bit", "half" or "float"
    bool linear = false;      // floats; integers are normalized and count as sRGB-encoded
    bool associated = false;  // colours are premultiplied by alpha (EXTRASAMPLES 1)
    FileNotes notes{};
};

// Whether the file begins like a TIFF.
bool isTiff(std::span<const std::byte> bytes);

// Reads the first page: grey or RGB, with or without alpha, unsigned integers of 8, 16 or 32 bits or
// floats of 16 or 32; strips or tiles, interleaved or planar; uncompressed, LZW, Deflate or PackBits.
// Rejects files that need more than `max` bytes decoded. Throws std::runtime_error, one line that names
// file and fault.
TiffImage readTiff(std::span<const std::byte> bytes, const std::string& name,
                   std::uint64_t max = limits::imageBytes());

// Reads only the tags. Throws std::runtime_error without the file's name.
ImageSize tiffSize(std::span<const std::byte> bytes);

}  // namespace diptych
