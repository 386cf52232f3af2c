// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

namespace diptych {

// The first `max` bytes of a regular file, whose size must not exceed `limit`. Throws std::runtime_error
// without its name: "no such file", "is a folder", "is 5000000000 bytes: at most 4294967296 are read".
std::vector<unsigned char> firstBytesOf(const std::filesystem::path& file, std::uint64_t limit,
                                        std::uint64_t max = std::numeric_limits<std::uint64_t>::max());

// All of a file of at most limits::imageBytes() bytes. Throws std::runtime_error: "FILE: no such file".
std::vector<unsigned char> bytesOf(const std::filesystem::path& file);

}  // namespace diptych
