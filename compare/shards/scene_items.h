// SPDX-License-Identifier: MIT
// The scenes of a command, and the ones of this shard.
#pragma once

#include "compare/shards/manifest.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace diptych::shards {

struct SceneItems {
    Shard shard;
    std::vector<Item> all;
    std::vector<const Item*> mine;  // in `all`, same order
    nlohmann::ordered_json plan;    // of Manifest: shards and scenes
};

// `several`: a folder per scene. `shard`: --shard; empty: all scenes. `timings`: --timings; empty: none.
// Throws std::runtime_error, one line, if they are invalid.
SceneItems itemsOf(const std::vector<std::string>& scenes, bool several, const std::string& shard,
                   const std::filesystem::path& timings);

// Name of a scene's kept part, and stamps of its files.
std::string partOf(const Item& item);
nlohmann::ordered_json stampOf(const std::string& scene);

// Runs `work` on one scene. If the scene cannot be read or rendered, returns the error, and the other scenes
// continue. Errors of this machine, such as a full disk, end the command.
std::optional<SceneError> attempt(const std::string& scene, const std::function<void()>& work);

}  // namespace diptych::shards
