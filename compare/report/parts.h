// SPDX-License-Identifier: MIT
// A report of many scenes is put together of parts, one for each scene, which are written as soon as it is
// compared: what is drawn of one scene is let go before the next, a command that is cut short goes on behind
// its last part, and parts that were made on several machines make the report that one machine makes of them
// all.
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
    std::string scene_folder;  // ReportOptions::scene_folder
    // What titles, lists and verdicts say of the scene: without pixels, figures and times, but with the time
    // of comparing.
    Report report;
    double encode_ms = 0;
    std::vector<std::string> tables;         // per comparison, for a terminal
    std::vector<std::string> closer_tables;  // per Report::closer_paths
    std::vector<std::string> closer_boxes;
    std::vector<IndexRow> rows;         // per comparison
    std::vector<std::string> sections;  // per comparison: its file
    std::vector<Exposure> exposures;    // per comparison
    std::vector<std::string> files;     // pictures, values and EXRs
    JunitSuite junit;                   // numbers alone

    std::vector<std::string> texts() const;  // its files that a report put together needs and does not keep
};

// Writes all files of one scene's report into `root`: those that a whole report has of it, each comparison's
// section, and the part's own. `part.json` comes last and at once, so that a part which has it is complete.
// The options have a scene_folder. Throws std::runtime_error naming the file.
ReportPart writePart(const Report& report, const std::filesystem::path& root, const ReportOptions& options);

// Reads it back. Throws std::runtime_error naming the file where it is missing, cut short or not ours.
ReportPart readPart(const std::filesystem::path& root, const std::string& scene_folder);
bool isPartThere(const std::filesystem::path& root, const std::string& scene_folder);

// A part, and the folder that its files are in.
struct PlacedPart {
    ReportPart part;
    std::filesystem::path root;
    bool kept = false;  // by this command, in a folder of its own: not by a shard, whose owner may change it
};

struct WholeReport {
    std::vector<PlacedPart> parts;  // in the order of the report
    std::vector<SceneError> errors;
    // Of a shard: the text of its manifest, and that the parts stay in the report, which is joined with
    // others.
    std::string shard;
};
inline constexpr const char* shardManifest = "shard.json";

// The rows of all its comparisons, in order.
std::vector<IndexRow> rowsOf(const WholeReport& whole);

// Put together, without pixels: for titles, lists and the verdict.
Report summaryOf(const WholeReport& whole);

// Writes the report into `folder` as writeReport() does. Files of parts that are `kept` are linked, or copied
// where that is impossible; those of others are copied. Throws std::runtime_error naming the file.
void writeWhole(const WholeReport& whole, const Report& summary, const std::filesystem::path& folder,
                const ReportOptions& options);

// reportTable() of it, and exposureLine(). `all`: else comparisons that pass are left out.
std::string wholeTable(const WholeReport& whole, const Report& summary, bool all);
std::string wholeExposureLine(const WholeReport& whole);

}  // namespace diptych
