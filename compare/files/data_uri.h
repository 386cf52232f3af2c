// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace diptych {

std::string base64(std::string_view bytes);

// "data:image/png;base64,..." of the file. Throws std::runtime_error naming the file where it cannot be read.
std::string dataUri(const std::filesystem::path& png);

}  // namespace diptych
