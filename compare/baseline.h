// SPDX-License-Identifier: MIT
// A Frame that was drawn earlier, or by somebody else, and lies in an EXR.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

struct ReportDevice;

// The channels that are called as ours; what else the file holds is named in the Frame's notes. Its Settings,
// scene, camera, device, driver and commit where the file is ours; of another renderer's the path is
// Path::reference, which has no tolerance of its own. Throws std::runtime_error, one line naming the file,
// where it cannot be read or holds none of our channels.
Frame frameFromExr(const std::filesystem::path& file);

// What must be known before any number is read: commit, device, driver, scene, camera and Settings of the
// baseline that are not those of `frame`, a line each.
std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device);

// Writes `frame` as the new `file`: beside it first, then renamed; the old file stays as FILE.old. Returns
// what was done as a line for the user. Throws std::runtime_error naming the file.
std::string updateBaseline(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

}  // namespace diptych
