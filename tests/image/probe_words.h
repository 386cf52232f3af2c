// SPDX-License-Identifier: MIT
// SPIR-V of the shaders in tests/probe/shaders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace diptych::tests {

inline std::vector<std::uint32_t> probeWords(const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(DIPTYCH_PROBE_DIR) / (name + ".spv");
    std::vector<std::uint32_t> words(std::filesystem::file_size(file) / 4);
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    return words;
}

}  // namespace diptych::tests
