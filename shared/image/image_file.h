// SPDX-License-Identifier: MIT
// Reads images of any renderer: OpenEXR, PNG, JPEG, TIFF, Radiance HDR and PFM files as layers of float32.
#pragma once

#include "shared/image/image_layers.h"
#include "shared/image/limits.h"
#include "shared/image/png.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace diptych {

// A file and, for a multi-part EXR, the requested part: "FILE.exr?part=NAME", or its index from 0. If a
// file of the whole name exists, it is that file.
struct ImageName {
    std::filesystem::path file;
    std::string part{};
};
ImageName imageName(const std::filesystem::path& words);

// Recognizes the format by the first bytes, not by the name. `part` selects one part of an EXR, whose
// layers then have no part name as prefix. "" reads all parts, or the part that imageName() finds. The
// file's bytes and the decoded image are in memory at the same time. Rejects files that need more than
// `max` bytes decoded. EightBits::kept: 8-bit PNG and JPEG fill ImageLayer::coded. Throws
// std::runtime_error, one line that names file and fault.
ImageFile readImage(const std::filesystem::path& file, std::string_view part = {});
ImageFile readImage(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                    std::uint64_t max = limits::imageBytes(), EightBits eight = EightBits::decoded);

// The size that readImage() would decode, from the header only. Throws as it does.
ImageSize imageSize(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                    EightBits eight = EightBits::decoded);

}  // namespace diptych
