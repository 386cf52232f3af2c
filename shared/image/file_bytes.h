// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace diptych {

// The whole of a regular file, up to limits::imageBytes(). Throws std::runtime_error: "FILE: no such file",
// "FILE: is a folder".
std::vector<std::byte> bytesOf(const std::filesystem::path& file);

}  // namespace diptych
