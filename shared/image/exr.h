// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// One layer of an EXR file: `image` component i is the channel `channels[i]`, e.g. "albedo.R" or "Z".
struct ExrLayer {
    std::string name;                   // "" for the unnamed layer (R, G, B, Z)
    std::vector<std::string> channels;  // full channel names, one per component of the image
    Image image;
};

// The same without owning the pixels, for writing.
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

// Reads every layer of the first part as it fills the display window (0 where no pixel is stored); half,
// float and uint channels become float32, components in the order R G B A X Y Z. Deep and subsampled pixels
// are refused, and what needs more than `most` bytes decoded. Throws std::runtime_error, one line naming file
// and fault.
std::vector<ExrLayer> readExr(const std::filesystem::path& file);
std::vector<ExrLayer> readExr(std::span<const std::byte> bytes, const std::string& name,
                              std::uint64_t most = limits::imageBytes());

}  // namespace diptych
