// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output.h"
#include "compare/report/report.h"
#include "compare/verdict/image_diff.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// For a terminal: as of two paths, with PSNR and SSIM. Ends in a newline. `errors`, `failures`: of two
// folders (FolderDiff).
std::string diffTable(std::span<const ImageDiff> diffs, const std::vector<SceneError>& errors = {},
                      const std::vector<SceneError>& failures = {});

// Writes the same report folder as for two paths, and takes the images out of `diffs`. `words`: command-line
// options, for the commands shown in the report. Throws std::runtime_error naming the file.
void writeDiffs(std::span<ImageDiff> diffs, const std::filesystem::path& folder, const ReportOptions& options,
                const std::vector<std::string>& words, const std::vector<SceneError>& errors = {},
                const std::vector<SceneError>& failures = {});

// Writes an EXR of every channel's errors (FLIP for colours with a FLIP rule, else the channel's pixel
// error), or an error image of the deciding channel. Throws std::runtime_error naming the file.
void writeDiffErrors(const ImageDiff& diff, const Output& output);

}  // namespace diptych
