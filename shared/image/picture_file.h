// SPDX-License-Identifier: MIT
// Reads pictures of any renderer: OpenEXR, PNG, JPEG, TIFF, Radiance HDR and PFM files as layers of float32.
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

// A file and, of an EXR of several parts, the one that is meant: "FILE.exr?part=NAME", or its number from 0.
// A file that is there under the whole name is that file.
struct PictureName {
    std::filesystem::path file;
    std::string part{};
};
PictureName pictureName(const std::filesystem::path& words);

// The format is recognised by the first bytes, whatever the file's name. `part` names the only part of an
// EXR to be read, whose layers then have no part name in front; "" reads all parts, or what pictureName()
// has. The file's bytes and the decoded picture are in memory at the same time; what needs more than `most`
// bytes decoded is refused. EightBits::kept: PNG and JPEG of 8 bits have PictureLayer::coded. Throws
// std::runtime_error, one line naming file and fault.
PictureFile readPicture(const std::filesystem::path& file, std::string_view part = {});
PictureFile readPicture(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                        std::uint64_t most = limits::imageBytes(), EightBits eight = EightBits::decoded);

// What readPicture() would decode, from the file's header. Throws as it does.
PictureSize pictureSize(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                        EightBits eight = EightBits::decoded);

}  // namespace diptych
