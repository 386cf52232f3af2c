// SPDX-License-Identifier: MIT
// The scenes of a command line, and what its results are known by.
#pragma once

#include "compare/cli/options.h"
#include "compare/shards/scene_items.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace diptych::cli {

// Applies --shard and --timings. `settings`: all cameras, times and paths. Throws std::runtime_error, one
// line, if they are invalid.
shards::SceneItems itemsOf(const Options& options, const std::vector<Settings>& settings);

// The inputs of a command's parts except scenes and device. An interrupted command reuses parts with the
// same key.
nlohmann::ordered_json resumeKey(const Options& options, const std::vector<Settings>& settings);

}  // namespace diptych::cli
