// SPDX-License-Identifier: MIT
// Portable float maps: a header of three words and float32 as they are. Debevec, "PFM Portable FloatMap Image
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

struct PfmPicture {
    Image image;             // 1 component (Pf) or RGB (PF), linear, row 0 on top
    std::size_t behind = 0;  // bytes in the file after the last pixel
    float scale = 1;         // that its values were multiplied by
};

// Reads both byte orders, as given by the sign of the scale. Values are multiplied by the scale's magnitude,
// whose meaning the format leaves open; a scale of 1 keeps every bit. Refuses what needs more than `most`
// bytes decoded. Throws std::runtime_error, one line naming file and fault.
PfmPicture readPfm(std::span<const std::byte> bytes, const std::string& name,
                   std::uint64_t most = limits::imageBytes());

// From its header. Throws std::runtime_error without the file's name.
PictureSize pfmSize(std::span<const std::byte> bytes);

// Writes an image of 1 or 3 components: little-endian, scale 1, bit-exact. Written beside `file` and
// renamed. Throws std::runtime_error naming the file.
void writePfm(const std::filesystem::path& file, const Image& image);

}  // namespace diptych
