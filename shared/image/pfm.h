// SPDX-License-Identifier: MIT
// Portable float maps: a header of three words, then raw float32. Debevec, "PFM Portable FloatMap Image
// Format" (pauldebevec.com/Research/HDR/PFM).
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace diptych {

struct PfmImage {
    Image image;             // one component (Pf) or RGB (PF), linear, row 0 on top
    std::size_t behind = 0;  // bytes after the last pixel
    float scale = 1;         // factor that was applied to the values
};

// Reads both byte orders, given by the sign of the scale. Multiplies values by the scale's magnitude,
// whose meaning the format leaves open; a scale of 1 preserves all bits. Rejects files that need more than
// `max` bytes decoded. Throws std::runtime_error, one line that names file and fault.
PfmImage readPfm(std::span<const std::byte> bytes, const std::string& name,
                 std::uint64_t max = limits::imageBytes());

// Reads only the header. Throws std::runtime_error without the file's name.
ImageSize pfmSize(std::span<const std::byte> bytes);

// Writes an image of 1 or 3 components: little-endian, scale 1, bit-exact. Replaces `file` atomically.
// Throws std::runtime_error that names the file.
void writePfm(const std::filesystem::path& file, const Image& image);

}  // namespace diptych
