// SPDX-License-Identifier: MIT
#include "compare/cli/scene_items.h"

#include "compare/files/checkpoint_folder.h"
#include "compare/files/diptych_files.h"
#include "compare/report/folders.h"
#include "shared/image/limits.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/named.h"

#include <system_error>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string contentsHash(const fs::path& file) {
    return named(file.string(), [&] { return hashOf(textIn(file, limits::imageBytes())); });
}

}  // namespace

void addContents(Json& asked, std::initializer_list<std::pair<const char*, fs::path>> files) {
    for (const auto& [name, file] : files)
        if (!file.empty()) asked[name] = contentsHash(reportFile(file));
}

Json askedOf(const ShardedGroup& options, const std::vector<Settings>& settings, const Json& own) {
    Json asked = Json::object();
    const Json first = parseOrderedJson(toJson(settings.front()));
    for (const auto& [name, value] : first.items())
        if (name != "camera" && name != "time" && name != "path") asked[name] = value;
    asked["cameras"] = options.cameras;
    asked["times"] = options.times;
    asked["paths"] = Json::array();
    for (const Settings& one : settings)
        if (one.camera == settings.front().camera && one.time == settings.front().time)
            asked["paths"].push_back(nameOf(one.path));
    asked["channels"] = options.channels;
    asked["runs"] = options.runs;
    asked["exposure"] = {options.image.exposure.value_or(0), options.image.ev100.value_or(0),
                         options.image.tonemap};
    addContents(asked, {{"match-exposure", options.match_exposure}, {"timings", options.timings}});
    asked.update(own);
    return asked;
}

shards::SceneItems itemsOf(const ShardedGroup& options, const Json& asked) {
    // One view of one scene needs no folder.
    const bool several = options.scenes.size() * options.cameras.size() * options.times.size() > 1;
    shards::SceneItems items = shards::itemsOf(options.scenes, several, options.shard, options.timings);
    items.plan["asked"] = asked;
    return items;
}

Json resumeKey(const ShardedGroup& options, const Json& asked) {
    Json files = Json::array();
    for (const std::string& name : {options.settings.valueOf("env"), options.settings.valueOf("lights")}) {
        std::error_code ignored;
        if (!name.empty() && fs::exists(name, ignored)) files.push_back(fileStamp(name));
    }
    return {{"schema", 1},    {"software", softwareName},          {"program", shards::programStamp()},
            {"asked", asked}, {"one", options.scenes.size() == 1},  // affects the folder of a scene
            {"files", files}};
}

}  // namespace diptych::cli
