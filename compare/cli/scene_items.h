// SPDX-License-Identifier: MIT
// The scenes of a command line, and what its results are known by.
#pragma once

#include "compare/cli/option_groups.h"
#include "compare/shards/scene_items.h"

#include <nlohmann/json.hpp>

#include <initializer_list>

namespace diptych::cli {

// Adds the contents of files, in which they are known on every machine. A folder stands for its report.json.
void addContents(nlohmann::ordered_json& asked,
                 std::initializer_list<std::pair<const char*, std::filesystem::path>> files);

// Options besides the scenes that affect the result, by name. `own`: of this command alone. `settings`: all
// cameras, times and paths.
nlohmann::ordered_json askedOf(const ShardedGroup& options, const std::vector<Settings>& settings,
                               const nlohmann::ordered_json& own);

// Applies --shard and --timings. Throws std::runtime_error, one line, if they are invalid.
shards::SceneItems itemsOf(const ShardedGroup& options, const nlohmann::ordered_json& asked);

// The inputs of a command's parts except scenes and device. An interrupted command reuses parts with the
// same key.
nlohmann::ordered_json resumeKey(const ShardedGroup& options, const nlohmann::ordered_json& asked);

}  // namespace diptych::cli
