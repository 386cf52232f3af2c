// SPDX-License-Identifier: MIT
// What `render` leaves of a Frame.
#pragma once

#include "compare/files/output.h"
#include "compare/picture/picture.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// One Frame: an EXR of the channels asked for, or a PNG of channel `shown`. Throws std::runtime_error naming
// the file, or the channel where the Frame does not have it.
void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice);

// Into the folder that is there: FRAME.exr, CHANNEL.png and frame.json, which lists all; returns their names.
std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder, const DebugMode& shown,
                                          const PictureChoice& choice);

}  // namespace diptych
