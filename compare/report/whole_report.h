// SPDX-License-Identifier: MIT
// Joins the parts of many scenes. Parts from several machines form the same report as one machine would.
#pragma once

#include "compare/report/parts.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

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
