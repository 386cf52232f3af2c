// SPDX-License-Identifier: MIT
#include "compare/viewer/scene_watch.h"

#include "compare/shards/partition.h"

#include <system_error>
#include <utility>

namespace diptych::viewer {
namespace fs = std::filesystem;

void SceneWatch::watch(const std::string& scene, const Settings& settings) {
    files_ = shards::filesOf(scene);
    if (settings.env != "none" && settings.env != "scene") files_.emplace_back(settings.env);
    if (settings.lights.ends_with(".json")) files_.emplace_back(settings.lights);
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
