// SPDX-License-Identifier: MIT
// Builds a report of many scenes from parts, one per scene. Each part is written as soon as its scene is
// compared, so that its Frames can be freed before the next scene. An interrupted command resumes after
// its last part. Parts from several machines form the same report as one machine would.
#pragma once

#include "compare/picture/picture.h"
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

// A part, and the folder of its files.
struct PlacedPart {
    ReportPart part;
    std::filesystem::path root;
    // Written by this command, in its own folder; false for a shard, whose owner may change it.
    bool kept = false;
};

struct WholeReport {
    std::vector<PlacedPart> parts;  // in the order of the report
    std::vector<SceneError> errors;
    // For a shard: the text of its manifest. Its parts stay in the report so that shards can be joined.
    std::string shard;
};
inline constexpr const char* shardManifest = "shard.json";

// The rows of all comparisons, in order.
std::vector<IndexRow> rowsOf(const WholeReport& whole);

// The joined report without pixels, for titles, lists and the verdict.
Report summaryOf(const WholeReport& whole);

// Writes the report into `folder` as writeReport() does. Files of `kept` parts are linked if possible,
// otherwise copied; files of other parts are copied. Throws std::runtime_error naming the file.
void writeWhole(const WholeReport& whole, const Report& summary, const std::filesystem::path& folder,
                const ReportOptions& options);

// reportTable() and exposureLine() of the whole report. `all` false: omits comparisons that pass.
std::string wholeTable(const WholeReport& whole, const Report& summary, bool all);
std::string wholeExposureLine(const WholeReport& whole);

}  // namespace diptych
