// SPDX-License-Identifier: MIT
#pragma once

#include "compare/diff.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace diptych {

// Every channel of the Frame that was asked for as float32 layers named after the debug modes; scene, camera,
// settings and device as attributes.
void writeFrameExr(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

std::string base64(std::string_view bytes);

// "data:image/png;base64,..." of the file.
std::string dataUri(const std::filesystem::path& png);

}  // namespace diptych
