// SPDX-License-Identifier: MIT
// A Frame that was drawn earlier, or by another renderer, with which new ones are compared.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Differences that a reader must know before any number: commit, device, driver, scene, camera and Settings
// of the baseline that are not those of `frame`, one line each.
std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device);

// Why a reference of Settings `reference` is no truth of the samples that `path` draws: lit is the mean of a
// pixel's, and there the reference has one place, or fewer. Empty where it is one.
std::string samplesProblem(const Settings& reference, const Settings& path);

// Writes `frame` as the new `file`: into a temporary file first, which is then renamed; the old file stays as
// FILE.old. Returns a line for the user that says what was done. Throws std::runtime_error naming the file.
std::string updateBaseline(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

}  // namespace diptych
