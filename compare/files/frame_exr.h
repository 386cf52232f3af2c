// SPDX-License-Identifier: MIT
// Reads and writes a Frame as OpenEXR.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>

namespace diptych {

// Writes each requested channel as a float32 layer named after its debug mode, and lit's uncertainty if
// present. Scene, camera, Settings and device become attributes.
void writeFrameExr(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

// Reads channels with our names; the Frame's notes name the others. Our own files also provide Settings,
// scene, camera, device, driver, commit, and the uncertainty of a reference. Other files get
// Path::reference, which has no derived tolerance. Throws std::runtime_error, one line naming the file, if
// it is unreadable or has none of our channels.
Frame frameFromExr(const std::filesystem::path& file);

}  // namespace diptych
