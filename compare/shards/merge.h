// SPDX-License-Identifier: MIT
// Reports of shards, joined to the one that a single program would have written.
#pragma once

#include "compare/report/parts.h"
#include "compare/shards/manifest.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::shards {

struct Joined {
    Manifest manifest;  // of the command: that of the shards that were joined
    WholeReport report;
    // Why it is not all of the command: a line for each shard that is missing, there twice or of another
    // command, and for each that is incomplete. Empty: it is.
    std::vector<std::string> problems;
};

// Joins the reports in `folders`, in any order. Of different commands those are joined that most folders are
// of (of as many, that of the first by name); what is missing of it becomes an error of each of its scenes.
// Throws std::runtime_error naming a folder that is no report of a shard.
Joined join(const std::vector<std::filesystem::path>& folders);

}  // namespace diptych::shards
