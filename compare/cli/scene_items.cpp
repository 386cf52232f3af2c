// SPDX-License-Identifier: MIT
#include "compare/cli/scene_items.h"

#include "compare/cli/verdict_words.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/our_files.h"
#include "shared/image/limits.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/named.h"

#include <utility>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string contentsHash(const fs::path& file) {
    return named(file.string(), [&] { return shards::hashOf(textIn(file, limits::imageBytes())); });
}

// Options that affect the result, besides the scenes, by name.
Json askedOf(const Options& options, const std::vector<Settings>& settings) {
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
    asked["baseline"] = nameOf(options.baseline);
    asked["channels"] = options.channels;
    asked["runs"] = options.runs;
    asked["twice"] = static_cast<int>(options.twice);
    asked["what counts"] = wordsOfWhatCounts(options);
    asked["explain"] = options.explain;
    asked["keep"] = static_cast<int>(options.keep);
    asked["exposure"] = {options.picture.exposure.value_or(0), options.picture.ev100.value_or(0),
                         options.picture.tonemap};
    asked["grid"] = options.grid;
    // Identify files by content: paths differ between machines.
    for (const auto& [name, file] : {std::pair<const char*, fs::path>{"tolerances", options.tolerances},
                                     {"mask", options.selection.mask},
                                     {"match-exposure", options.match_exposure},
                                     {"timings", options.timings}}) {
        std::error_code ignored;
        const fs::path path = fs::is_directory(file, ignored) ? file / "report.json" : file;
        if (!file.empty()) asked[name] = contentsHash(path);
    }
    return asked;
}

}  // namespace

shards::SceneItems itemsOf(const Options& options, const std::vector<Settings>& settings) {
    // One view of one scene needs no folder.
    const bool several = options.scenes.size() * options.cameras.size() * options.times.size() > 1 ||
                         !options.baseline_file.empty();
    shards::SceneItems items = shards::itemsOf(options.scenes, several, options.shard, options.timings);
    items.plan["asked"] = askedOf(options, settings);
    return items;
}

Json resumeKey(const Options& options, const std::vector<Settings>& settings) {
    Json files = Json::array();
    for (const std::string& name : {options.settings.valueOf("env"), options.settings.valueOf("lights")}) {
        std::error_code ignored;
        if (!name.empty() && fs::exists(name, ignored)) files.push_back(fileStamp(name));
    }
    return {{"schema", 1},
            {"software", softwareName},
            {"program", shards::programStamp()},
            {"command", options.command},
            {"asked", askedOf(options, settings)},
            {"one", options.scenes.size() == 1},  // affects the folder of a scene
            {"single_file", options.single_file},
            {"files", files}};
}

}  // namespace diptych::cli
