// SPDX-License-Identifier: MIT
// A Frame as an OpenEXR file.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>

namespace diptych {

// Every channel of the Frame that was asked for as float32 layers named after the debug modes, and beside lit
// its uncertainty where there is one; scene, camera, settings and device as attributes.
void writeFrameExr(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

// The channels that are called as ours; what else the file holds is named in the Frame's notes. Its Settings,
// scene, camera, device, driver and commit where the file is ours, and of a reference how far its lit is
// known; of another renderer's the path is Path::reference, which has no tolerance of its own. Throws
// std::runtime_error, one line naming the file, where it cannot be read or holds none of our channels.
Frame frameFromExr(const std::filesystem::path& file);

}  // namespace diptych
