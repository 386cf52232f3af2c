// SPDX-License-Identifier: MIT
// Writes a report's files that contain pixels.
#pragma once

#include "compare/report/layout.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"

#include <filesystem>

namespace diptych {

// Writes the EXRs, images and values that the layout names into `folder`, whose subfolders must exist.
// With ReportLayout::single_file, fills ReportLayout::embedded instead. Also fills in the layout's
// histograms and worst pixels, and the shared name of identical images. Throws std::runtime_error naming
// the file.
void encode(const Report& report, ReportLayout& layout, const std::filesystem::path& folder,
            const Stage& progress);

}  // namespace diptych
