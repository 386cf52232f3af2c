// SPDX-License-Identifier: MIT
// One scene's part of a report of many scenes. It is written as soon as its scene is compared, so that its
// Frames can be freed before the next scene. An interrupted command resumes after its last part.
#pragma once

#include "compare/image/channel_image.h"
#include "compare/report/report_options.h"
#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct ReportPart {
    std::string scene_folder;
    // The scene's titles, lists and verdicts, without pixels, metrics and times except the comparison
    // time.
    Report report;
    double encode_ms = 0;
    std::vector<std::string> tables;         // per comparison, for a terminal
    std::vector<std::string> closer_tables;  // per Report::closer_paths
    std::vector<std::string> closer_boxes;
    std::vector<IndexRow> rows;         // per comparison
    std::vector<std::string> sections;  // per comparison: its file
    std::vector<Exposure> exposures;    // per comparison
    std::vector<std::string> files;     // images, values and EXRs
    JunitSuite junit;                   // only its counts

    std::vector<std::string> texts() const;  // files that only joining the parts needs
};

// Writes all files of one scene's report into `root`: those of the final report, each comparison's
// section, and the part's own. `part.json` is written last and atomically, so a part that has it is
// complete. `options.scene_folder` must be set. Throws std::runtime_error naming the file.
ReportPart writePart(const Report& report, const std::filesystem::path& root, const ReportOptions& options);

// Reads it back. Throws std::runtime_error naming the file if it is missing, truncated or of another
// format.
ReportPart readPart(const std::filesystem::path& root, const std::string& scene_folder);
bool isPartThere(const std::filesystem::path& root, const std::string& scene_folder);

// Texts that only joining the parts needs: arrays of report.json (reportArrays) and suites of junit.xml, in
// their final form.
inline constexpr std::size_t junitText = 3;
std::string readPartText(const std::filesystem::path& root, const ReportPart& part, std::size_t text);
// The section inside a part's script.
std::string sectionIn(const std::filesystem::path& root, const std::string& script);

}  // namespace diptych
