// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output.h"
#include "compare/report/picture_diff_json.h"
#include "compare/report/report.h"
#include "compare/verdict/picture_diff.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// For a terminal: as of two paths, with PSNR and SSIM. Ends in a newline.
std::string pictureDiffTable(const PictureDiff& diff);
std::string folderDiffTable(const FolderDiff& diff);

// Writes an EXR of every channel's errors (FLIP for colours with a FLIP rule, else the channel's pixel
// error), an error image of the deciding channel, or the same report folder as for two paths. Throws
// std::runtime_error naming the file. `words`: command-line options, for the commands shown in the report.
void writePictureDiff(PictureDiff diff, const Output& output, const ReportOptions& options,
                      const std::vector<std::string>& words);

// The same report for several pairs, those of two folders. Throws as writePictureDiff().
void writePictureDiffs(std::vector<PictureDiff> diffs, const std::filesystem::path& folder,
                       const ReportOptions& options, const std::vector<std::string>& words,
                       const std::vector<SceneError>& errors, const std::vector<SceneError>& failures);

}  // namespace diptych
