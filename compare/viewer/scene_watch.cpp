// SPDX-License-Identifier: MIT
#include "compare/viewer/scene_watch.h"

#include "shared/scene/gltf/resources.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <system_error>

namespace diptych::viewer {
namespace {

namespace fs = std::filesystem;

// What a glTF names as buffers and images, beside it. Nothing of a file that is no JSON: loading says what is
// wrong.
std::vector<fs::path> named(const fs::path& scene) {
    std::vector<fs::path> files;
    std::ifstream stream(scene, std::ios::binary);
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_object()) return files;
    for (const char* list : {"buffers", "images"}) {
        const auto found = json.find(list);
        if (found == json.end() || !found->is_array()) continue;
        for (const nlohmann::json& each : *found)
            if (each.is_object() && each.contains("uri") && each["uri"].is_string())
                if (const auto uri = each["uri"].get<std::string>(); !uri.starts_with("data:"))
                    files.push_back(scene.parent_path() / gltf::percentDecoded(uri));
    }
    return files;
}

}  // namespace

void SceneWatch::watch(const std::string& scene, const std::vector<fs::path>& others) {
    files_ = others;
    if (!scene.starts_with("builtin:")) {
        // FILE.glb?scene=NAME is one of the file's scenes.
        const fs::path file(scene.substr(0, scene.rfind("?scene=")));
        files_.push_back(file);
        if (file.extension() == ".gltf")
            for (fs::path& each : named(file)) files_.push_back(std::move(each));
    }
    known_ = last_ = times();
}

SceneWatch::Times SceneWatch::times() const {
    Times times;
    for (const fs::path& file : files_) {
        std::error_code gone;  // a file that is being replaced
        const fs::file_time_type time = fs::last_write_time(file, gone);
        if (!gone) times[file] = time;
    }
    return times;
}

bool SceneWatch::changed() {
    Times now = times();
    const bool settled = now == last_ && now != known_;
    last_ = std::move(now);
    if (settled) known_ = last_;
    return settled;
}

}  // namespace diptych::viewer
