// SPDX-License-Identifier: MIT
#include "compare/shards/scene_items.h"

#include "compare/files/checkpoint_folder.h"
#include "compare/report/folders.h"

#include <cstdlib>
#include <map>
#include <stdexcept>
#include <system_error>

namespace diptych::shards {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

SceneItems itemsOf(const std::vector<std::string>& scenes, bool several, const std::string& shard,
                   const fs::path& timings) {
    SceneItems items;
    const auto environment = [](const char* name) {
        const char* value = std::getenv(name);
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    if (!shard.empty()) items.shard = shardOf(shard, environment);
    const std::map<std::string, double> known =
        timings.empty() ? std::map<std::string, double>() : timingsOf(timings);
    const std::vector<int> parts = partition(weightsOf(scenes, known), items.shard.count);
    const std::vector<std::string> folders = sceneFolders(scenes);
    Json listed = Json::array();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        items.all.push_back({scenes[i], several ? folders[i] : "", parts[i]});
        listed.push_back({scenes[i], bytesOf(scenes[i])});
    }
    for (const Item& item : items.all)
        if (item.shard == items.shard.index) items.mine.push_back(&item);
    items.plan = {{"shards", items.shard.count}, {"scenes", listed}};
    return items;
}

std::string partOf(const Item& item) {
    return item.folder.empty() ? "scene" : item.folder.substr(0, item.folder.size() - 1) + "-scene";
}

Json stampOf(const std::string& scene) {
    Json files = Json::array();
    for (const fs::path& file : filesOf(scene)) files.push_back(fileStamp(file));
    return {{"scene", scene}, {"files", files}};
}

std::optional<SceneError> attempt(const std::string& scene, const std::function<void()>& work) {
    try {
        work();
        return {};
    } catch (const std::system_error&) {
        throw;
    } catch (const std::runtime_error& error) {
        return SceneError{scene, error.what()};
    }
}

}  // namespace diptych::shards
