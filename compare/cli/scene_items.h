// SPDX-License-Identifier: MIT
// The scenes of a command, and the ones of this shard.
#pragma once

#include "compare/cli/options.h"
#include "compare/shards/manifest.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace diptych::cli {

struct SceneItems {
    shards::Shard shard;
    std::vector<shards::Item> all;
    std::vector<const shards::Item*> mine;  // in `all`, same order
    nlohmann::ordered_json plan;            // of shards::Manifest
};

// Applies --shard and --timings. `settings`: all cameras, times and paths. Throws std::runtime_error, one
// line, if they are invalid.
SceneItems itemsOf(const Options& options, const std::vector<Settings>& settings);

// resumeKey(): the inputs of a command's parts except scenes and device. An interrupted command reuses
// parts with the same key. stampOf() detects changed scene files.
nlohmann::ordered_json resumeKey(const Options& options, const std::vector<Settings>& settings);
nlohmann::ordered_json stampOf(const std::string& scene);

}  // namespace diptych::cli
