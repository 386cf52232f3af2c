// SPDX-License-Identifier: MIT
// report.json and junit.xml.
#pragma once

#include "compare/report/layout.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>

namespace diptych {

// report.json, schema 1. JSON has no infinity: a statistic that is infinite is null, and infinite_pixels then
// says at how many pixels; a forward-only channel's statistics are all null. `layout` may be nullptr.
std::string reportJson(const Report& report, const ReportLayout* layout);

// One test case per scene x camera x channel; one more where a comparison fails for another reason than a
// channel. The pictures of a failing channel are named as attachments in `folder`. CI servers resolve them
// against the working directory of the job, so a relative folder stays relative.
std::string reportJunit(const Report& report, const ReportLayout& layout,
                        const std::filesystem::path& folder);

}  // namespace diptych
