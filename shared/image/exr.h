// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"
#include "shared/image/picture_layers.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A layer to write: component i of `image` is the channel `channels[i]`, e.g. "albedo.R" or "Z".
struct ExrLayerView {
    std::vector<std::string> channels;
    const Image* image;
};

struct ExrAttribute {
    std::string name, value;
};

// Writes every layer as float32 into one scan-line part (ZIP compressed, on all cores), with the string
// attributes given. Written beside `file` and renamed. Throws std::runtime_error naming the file.
void writeExr(const std::filesystem::path& file, const std::vector<ExrLayerView>& layers,
              const std::vector<ExrAttribute>& attributes = {});

// Every layer of every part, or of the one named `part`, as it fills the display window (0 where no pixel is
// stored). Tiles and lines, all compressions; of mip-mapped tiles the largest level. Deep and subsampled
// pixels are refused, parts of different display windows, and what needs more than `most` bytes decoded.
// Throws std::runtime_error, one line naming file, part and fault.
PictureFile readExr(const std::filesystem::path& file);
PictureFile readExr(std::span<const std::byte> bytes, const std::string& name,
                    std::uint64_t most = limits::imageBytes(), std::string_view part = {});

}  // namespace diptych
