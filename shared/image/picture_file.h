// SPDX-License-Identifier: MIT
// Pictures of any renderer: OpenEXR, PNG, Radiance HDR and PFM files as layers of float32.
#pragma once

#include "shared/image/limits.h"
#include "shared/image/picture_layers.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace diptych {

// The format is told by the first bytes, whatever the name ends in. `part` names the one part of an EXR that
// is read, its layers without the part's name; "" reads all. The file's bytes and what is decoded are in
// memory together; what needs more than `most` bytes decoded is refused. Throws std::runtime_error, one line
// naming file and fault.
PictureFile readPicture(const std::filesystem::path& file, std::string_view part = {});
PictureFile readPicture(std::span<const std::byte> bytes, const std::string& name, std::string_view part = {},
                        std::uint64_t most = limits::imageBytes());

}  // namespace diptych
