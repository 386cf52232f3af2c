// SPDX-License-Identifier: MIT
// The files that `render` writes for a Frame.
#pragma once

#include "compare/files/output.h"
#include "compare/image/channel_image.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// The channels to write as images; at least one.
using ChannelSelection = std::vector<const DebugMode*>;

// For an output of kind png: "x.png", or "x.CHANNEL.png" for each of several channels.
std::vector<std::filesystem::path> imageFiles(const std::filesystem::path& png,
                                              const ChannelSelection& selected);

// Writes one Frame: an EXR of the requested channels, or imageFiles(). Throws std::runtime_error naming
// the file, or the channel that the Frame lacks.
void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output,
                const ChannelSelection& selected, const ImageChoice& choice);

// Writes FRAME.exr, a CHANNEL.png for each channel, and frame.json, which lists all files, into an
// existing folder; returns their names.
std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder,
                                          const ChannelSelection& selected, const ImageChoice& choice);

}  // namespace diptych
