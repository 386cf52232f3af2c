// SPDX-License-Identifier: MIT
// Compares new Frames with one rendered earlier or by another renderer.
#pragma once

#include "shared/frame/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Differences that a reader must know before any metric: commit, device, driver, scene, camera and
// Settings in which the baseline differs from `frame`, one line each.
std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device);

// Why a reference with Settings `reference` is no ground truth for the samples of `path`: lit is the mean
// of a pixel's samples, but that reference has one sample location, or fewer. Empty if it is.
std::string samplesProblem(const Settings& reference, const Settings& path);

// Replaces `file` by `frame` atomically, with a temporary file; the old file stays as FILE.old. Returns a
// line for the user about it. Throws std::runtime_error naming the file.
std::string updateBaseline(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device);

}  // namespace diptych
