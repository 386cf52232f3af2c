// SPDX-License-Identifier: MIT
// Merges reports of shards into the report of a single run.
#pragma once

#include "compare/report/whole_report.h"
#include "compare/shards/manifest.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::shards {

// Folders of shards that belong to one command.
struct Chosen {
    Manifest manifest;                             // of the command; without errors
    std::map<int, std::filesystem::path> folders;  // key: shard
    std::map<int, std::vector<SceneError>> errors;
    std::vector<std::string> problems;  // see Joined::problems

    // Why the scene has no result: its shard is missing or failed.
    std::optional<SceneError> errorOf(const Item& item) const;
};
// Reads the manifests named `file`; otherwise like join().
Chosen choose(const std::vector<std::filesystem::path>& folders, const char* file);

struct Joined {
    Manifest manifest;  // of the merged shards' command
    WholeReport report;
    // Why the report is incomplete: a line per shard that is missing, duplicate, of another command, or
    // incomplete itself. Empty if it is complete.
    std::vector<std::string> problems;
};

// Merges the reports in `folders`, in any order. With several commands, takes that of most folders; ties
// go to the first by name. Scenes of missing shards become errors. Throws std::runtime_error if no folder
// has a shard's report.
Joined join(const std::vector<std::filesystem::path>& folders);

}  // namespace diptych::shards
