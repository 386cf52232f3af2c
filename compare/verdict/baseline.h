// SPDX-License-Identifier: MIT
// A Frame that was drawn earlier, or by somebody else, as what new ones are held against.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// What must be known before any number is read: commit, device, driver, scene, camera and Settings of the
// baseline that are not those of `frame`, a line each.
std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device);

// Writes `frame` as the new `file`: beside it first, then renamed; the old file stays as FILE.old. Returns
// what was done as a line for the user. Throws std::runtime_error naming the file.
std::string updateBaseline(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

}  // namespace diptych
