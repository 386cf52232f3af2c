// SPDX-License-Identifier: MIT
// Reads images of any renderer: OpenEXR, PNG, JPEG, TIFF, Radiance HDR and PFM files as layers of float32.
#pragma once

#include "shared/image/limits.h"
#include "shared/image/picture_layers.h"
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
struct PictureName {
    std::filesystem::path file;
    std::string part{};
};
PictureName pictureName(const std::filesystem::path& words);

// Recognizes the format by the first bytes, not by the name. `part` selects one part of an EXR, whose
// layers then have no part name as prefix. "" reads all parts, or the part that pictureName() finds. The
// file's bytes and the decoded image are in memory at the same time. Rejects files that need more than
// `most` bytes decoded. EightBits::kept: 8-bit PNG and JPEG fill PictureLayer::coded. Throws
// std::runtime_error, one line that names file and fault.
PictureFile readPicture(const std::filesystem::path& file, std::string_view part = {});
PictureFile readPicture(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                        std::uint64_t most = limits::imageBytes(), EightBits eight = EightBits::decoded);

// The size that readPicture() would decode, from the header only. Throws as it does.
PictureSize pictureSize(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                        EightBits eight = EightBits::decoded);

}  // namespace diptych
