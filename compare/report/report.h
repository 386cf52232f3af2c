// SPDX-License-Identifier: MIT
// The report that a comparison writes, for people and for scripts.
#pragma once

#include "compare/report/report_options.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// index.html, report.json, junit.xml, an EXR per frame and the page's pictures. Everything is written into a
// temporary folder first and put in place at once, so an earlier report stays complete until the new one is.
// Files that the earlier report.json lists and the new one does not are removed; all other files in the
// folder stay. Of several scenes each has a folder. Returns the text of report.json. Throws
// std::runtime_error naming folder or file.
std::string writeReport(const Report& report, const std::filesystem::path& folder,
                        const ReportOptions& options);

// The folder that the commands of a report write to, which repeat a part of it: beside the report, which they
// must not replace.
std::string againFolder(const std::filesystem::path& folder);

// For a terminal: a table per comparison, failures first, then one line of verdict. Ends in a newline.
std::string reportTable(const Report& report);

// Its parts: of one comparison; of a scene, camera and time against the reference, named where there are
// `several`; and what stands below all.
std::string comparisonTable(const Report& report, const Comparison& comparison);
std::string closerTable(const Report& report, const CloserPath& closer, bool several);
std::string tableEnd(const Report& report);

}  // namespace diptych
