// SPDX-License-Identifier: MIT
#include "compare/cli/scene_items.h"

#include "compare/cli/verdict_words.h"
#include "compare/files/our_files.h"
#include "compare/report/folders.h"
#include "shared/image/limits.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/named.h"

#include <cstdlib>
#include <map>
#include <optional>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string contentsHash(const fs::path& file) {
    return named(file.string(), [&] { return shards::hashOf(textIn(file, limits::imageBytes())); });
}

Json fileStamp(const fs::path& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) return {file.string(), nullptr};
    return {file.string(), size, fs::last_write_time(file, error).time_since_epoch().count()};
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

SceneItems itemsOf(const Options& options, const std::vector<Settings>& settings) {
    SceneItems items;
    const auto environment = [](const char* name) {
        const char* value = std::getenv(name);
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    if (!options.shard.empty()) items.shard = shards::shardOf(options.shard, environment);
    const std::map<std::string, double> timings =
        options.timings.empty() ? std::map<std::string, double>() : shards::timingsOf(options.timings);
    const std::vector<int> parts =
        shards::partition(shards::weightsOf(options.scenes, timings), items.shard.count);
    // One view of one scene needs no folder.
    const bool several = options.scenes.size() * options.cameras.size() * options.times.size() > 1 ||
                         (!options.baseline_file.empty());
    const std::vector<std::string> folders = sceneFolders(options.scenes);
    Json scenes = Json::array();
    for (std::size_t i = 0; i < options.scenes.size(); ++i) {
        items.all.push_back({options.scenes[i], several ? folders[i] : "", parts[i]});
        scenes.push_back({options.scenes[i], shards::bytesOf(options.scenes[i])});
    }
    for (const shards::Item& item : items.all)
        if (item.shard == items.shard.index) items.mine.push_back(&item);
    items.plan = {{"shards", items.shard.count}, {"scenes", scenes}, {"asked", askedOf(options, settings)}};
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

Json stampOf(const std::string& scene) {
    Json files = Json::array();
    for (const fs::path& file : shards::filesOf(scene)) files.push_back(fileStamp(file));
    return {{"scene", scene}, {"files", files}};
}

}  // namespace diptych::cli
