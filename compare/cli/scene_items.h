// SPDX-License-Identifier: MIT
// The scenes of a command that takes many, and which of them this program has.
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
    std::vector<const shards::Item*> mine;  // of `all`, in its order
    nlohmann::ordered_json plan;            // of shards::Manifest
};

// As --shard and --timings say. `settings`: of every camera, time and path. Throws std::runtime_error, one
// line, where they say nothing that can be done.
SceneItems itemsOf(const Options& options, const std::vector<Settings>& settings);

// Everything but scenes and device that the parts of a command depend on: those of another are of no use when
// it is gone on with. And what tells that a scene's files are those that they were.
nlohmann::ordered_json resumeKey(const Options& options, const std::vector<Settings>& settings);
nlohmann::ordered_json stampOf(const std::string& scene);

}  // namespace diptych::cli
