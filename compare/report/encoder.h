// SPDX-License-Identifier: MIT
// The files of a report that are made of pixels.
#pragma once

#include "compare/report/layout.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"

#include <filesystem>

namespace diptych {

// Writes the EXRs, pictures and values that the layout names into `folder`, which has the folders that they
// stand in; of a single file, makes the pictures that the page holds (ReportLayout::embedded). Fills in the
// figures that the layout shows with the pictures, and the one name of pictures that turn out to be the same.
// Throws std::runtime_error naming the file.
void encode(const Report& report, ReportLayout& layout, const std::filesystem::path& folder,
            const Stage& progress);

}  // namespace diptych
