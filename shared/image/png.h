// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace diptych {

// 8 bits a component, row 0 on top; 3 (RGB) or 4 (RGBA) components.
struct Image8 {
    int width = 0, height = 0, components = 3;
    std::vector<std::uint8_t> data;
};

// Written beside `file` and renamed. Throws std::runtime_error naming the file.
void writePng(const std::filesystem::path& file, const Image8& image);

// Any PNG as RGBA, 8 bits. Throws std::runtime_error naming file and fault.
Image8 readPng(const std::filesystem::path& file);

}  // namespace diptych
