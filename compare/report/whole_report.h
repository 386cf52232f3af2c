// SPDX-License-Identifier: MIT
// Joins the parts of many scenes. Parts from several machines form the same report as one machine would.
#pragma once

#include "compare/report/parts.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// A part, and the folder of its files.
struct LocatedPart {
    ReportPart part;
    std::filesystem::path root;
    // Written by this command, in its own folder; false for a shard, whose owner may change it.
    bool written_here = false;
};

struct WholeReport {
    std::vector<LocatedPart> parts;  // in the order of the report
    std::vector<SceneError> errors;
    // For a shard: the text of its manifest. Its parts stay in the report so that shards can be joined.
    std::string shard;
};
inline constexpr const char* shardManifest = "shard.json";

// All parts as one, in order. Moves all but the names of files out of the parts.
ReportPart joinedOf(WholeReport& whole);

// Writes the report of all parts, `joined`, into `folder` as writeReport() does. Files of `written_here`
// parts are linked if possible, otherwise copied; files of other parts are copied. Throws std::runtime_error
// naming the file.
void writeWhole(const WholeReport& whole, const ReportPart& joined, const std::filesystem::path& folder,
                const ReportOptions& options);

// reportTable() of the whole report. `all` false: omits comparisons that pass.
std::string tableOf(const ReportPart& joined, bool all);

}  // namespace diptych
