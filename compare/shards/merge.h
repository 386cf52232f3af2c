// SPDX-License-Identifier: MIT
// Reports of shards, joined to the one that a single program would have written.
#pragma once

#include "compare/report/parts.h"
#include "compare/shards/manifest.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::shards {

// Of folders that shards wrote, those of one command.
struct Chosen {
    Manifest manifest;                             // of the command; without errors
    std::map<int, std::filesystem::path> folders;  // by shard
    std::map<int, std::vector<SceneError>> errors;
    std::vector<std::string> problems;  // as of Joined

    // Why there is nothing of the scene: its shard is missing, or could not do it.
    std::optional<SceneError> errorOf(const Item& item) const;
};
// By the manifest that is called `file`. As join().
Chosen choose(const std::vector<std::filesystem::path>& folders, const char* file);

struct Joined {
    Manifest manifest;  // of the command: that of the shards that were joined
    WholeReport report;
    // Why it is not all of the command: a line for each shard that is missing, there twice or of another
    // command, and for each that is incomplete. Empty: it is.
    std::vector<std::string> problems;
};

// Joins the reports in `folders`, in any order. Of different commands those are joined that most folders are
// of (of as many, that of the first by name); what is missing of it becomes an error of each of its scenes.
// Throws std::runtime_error where no folder is the report of a shard.
Joined join(const std::vector<std::filesystem::path>& folders);

}  // namespace diptych::shards
