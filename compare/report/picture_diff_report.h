// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output.h"
#include "compare/report/report.h"
#include "compare/verdict/picture_diff.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Writes an EXR of every channel's errors (FLIP's for colours that FLIP judges, else those of the channel's
// metric), a picture of the errors of the deciding channel, or a folder with the same report as for two
// paths. Throws std::runtime_error naming the file. `words`: the options of the command line, for commands
// that repeat it.
void writePictureDiff(PictureDiff diff, const Output& output, const ReportOptions& options,
                      const std::vector<std::string>& words);

// The same report of several pairs, those of two folders. Throws as writePictureDiff().
void writePictureDiffs(std::vector<PictureDiff> diffs, const std::filesystem::path& folder,
                       const ReportOptions& options, const std::vector<std::string>& words,
                       const std::vector<SceneError>& errors, const std::vector<SceneError>& failures);

}  // namespace diptych
