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
    std::size_t behind = 0;  // bytes in the file after its last pixel
};

// Both byte orders, by the sign of the scale; values are multiplied by its magnitude, which the format leaves
// open: 1 keeps every bit of them. What needs more than `most` bytes decoded is refused. Throws
// std::runtime_error, one line naming file and fault.
PfmPicture readPfm(std::span<const std::byte> bytes, const std::string& name,
                   std::uint64_t most = limits::imageBytes());

// An image of 1 or 3 components: little-endian, scale 1, every bit. Written beside `file` and renamed. Throws
// std::runtime_error naming the file.
void writePfm(const std::filesystem::path& file, const Image& image);

}  // namespace diptych
