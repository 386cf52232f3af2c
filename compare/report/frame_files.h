// SPDX-License-Identifier: MIT
// The files that `render` writes of a Frame.
#pragma once

#include "compare/files/output.h"
#include "compare/picture/picture.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Writes one Frame: an EXR of the requested channels, or a PNG of channel `shown`. Throws std::runtime_error
// naming the file, or the channel where the Frame does not have it.
void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice);

// Writes FRAME.exr, CHANNEL.png and frame.json, which lists all three, into an existing folder; returns their
// names.
std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder, const DebugMode& shown,
                                          const PictureChoice& choice);

}  // namespace diptych
