// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output.h"
#include "compare/report/report.h"
#include "compare/verdict/picture_diff.h"

namespace diptych {

// An EXR of every channel's errors (FLIP's for colours that FLIP judges, else of the channel's metric), a
// picture of the channel's errors that decides, or a folder with the same report as of two paths. Throws
// std::runtime_error naming the file.
// `words`: of the command line, for commands that repeat it.
void writePictureDiff(PictureDiff diff, const Output& output, const ReportOptions& options,
                      const std::vector<std::string>& words);

}  // namespace diptych
