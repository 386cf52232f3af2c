// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image.h"
#include "shared/image/image_layers.h"
#include "shared/image/limits.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A layer to write: component i of `image` is the channel `channels[i]`, such as "albedo.R" or "Z".
struct ExrLayerView {
    std::vector<std::string> channels;
    const Image* image;
};

struct ExrAttribute {
    std::string name, value;
};

// Writes all layers as float32 into one scan-line part (ZIP, on all cores), with the string attributes.
// Replaces `file` atomically. Releases pages of pixels that are spilled to disk. Throws std::runtime_error
// that names the file.
void writeExr(const std::filesystem::path& file, const std::vector<ExrLayerView>& layers,
              const std::vector<ExrAttribute>& attributes = {});

// Reads all layers of every part, or of the part named `part`, over the display window; missing pixels are
// 0. Supports tiles and scan lines and all compressions; of mip-mapped tiles, reads the largest level.
// Rejects deep and subsampled pixels, parts with different display windows, and files that need more than
// `max` bytes decoded. Throws std::runtime_error, one line that names file, part and fault.
ImageFile readExr(const std::filesystem::path& file);
ImageFile readExr(std::span<const std::byte> bytes, const std::string& name,
                  std::uint64_t max = limits::imageBytes(), std::string_view part = {});

}  // namespace diptych
