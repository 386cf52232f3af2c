// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/limits.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// 8 bits a component, row 0 on top; 3 (RGB) or 4 (RGBA) components.
struct Image8 {
    int width = 0, height = 0, components = 3;
    std::vector<std::uint8_t> data;
};

// Written beside `file` and renamed. Throws std::runtime_error naming the file.
void writePng(const std::filesystem::path& file, const Image8& image);

// Any PNG as RGBA, 8 bits; what needs more than `most` bytes decoded is refused. Throws std::runtime_error,
// one line naming file and fault.
Image8 readPng(const std::filesystem::path& file);
Image8 readPng(std::span<const std::byte> bytes, const std::string& name,
               std::uint64_t most = limits::imageBytes());

}  // namespace diptych
