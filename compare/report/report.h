// SPDX-License-Identifier: MIT
// The report that a comparison writes, for people and for scripts.
#pragma once

#include "compare/report/report_options.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Writes index.html, report.json, junit.xml, an EXR per frame and the page's images. All files replace an
// earlier report atomically: they are first written to a temporary folder. Files listed only in the
// earlier report.json are removed; all other files in the folder stay. With several scenes, each has a
// folder. Returns the text of report.json. Throws std::runtime_error naming the folder or file.
std::string writeReport(const Report& report, const std::filesystem::path& folder,
                        const ReportOptions& options);

// Output folder for the commands that a report shows: beside the report, which they must not replace.
std::string againFolder(const std::filesystem::path& folder);

// For a terminal: each comparison, failures first, then one line with the verdict. Ends in a newline.
std::string reportTable(const Report& report);
std::string tableEnd(const Report& report);  // the lines below all comparisons

}  // namespace diptych
