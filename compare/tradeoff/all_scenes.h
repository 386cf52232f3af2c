// SPDX-License-Identifier: MIT
// The page that links the sweeps of many scenes.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::tradeoff {

inline constexpr const char* tradeoffsManifest = "tradeoffs.json";

// A scene and its folder below the page's, which ends in a slash or is empty.
struct SweptScene {
    std::string scene, folder;
};

// Throws std::runtime_error naming the file if a scene's folder below `root` holds no tradeoff, or one of
// the files in it is of another kind than a tradeoff's or holds other markup.
void checkSwept(const std::filesystem::path& root, const SweptScene& scene,
                const std::vector<std::string>& files);

// Writes index.html and `manifest` with a list of the scenes; returns the manifest. `failures`: a line for
// each other scene.
std::string writeAllScenes(const std::filesystem::path& folder, nlohmann::ordered_json manifest,
                           const std::vector<SweptScene>& scenes, const std::vector<std::string>& failures,
                           bool force);

}  // namespace diptych::tradeoff
