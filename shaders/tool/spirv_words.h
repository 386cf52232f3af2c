// SPDX-License-Identifier: MIT
// SPIR-V module, by section 2.3 of the specification: a header of five words, then instructions whose
// first word is length << 16 | opcode.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

using Words = std::vector<std::uint32_t>;

inline Words readModule(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    Words words(static_cast<std::size_t>(std::filesystem::file_size(file)) / 4);
    in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    if (!in || words.size() < 5 || words[0] != 0x07230203)
        throw std::runtime_error(file + ": not a SPIR-V module");
    return words;
}
