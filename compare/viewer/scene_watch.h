// SPDX-License-Identifier: MIT
// Detects changes of a scene's files on disk.
#pragma once

#include "shared/frame/settings.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace diptych::viewer {

class SceneWatch {
public:
    // Watches a scene's file, the files that a .gltf names, and the Settings' environment and file of
    // lights. A built-in scene has no files.
    void watch(const std::string& scene, const Settings& settings);
    // True once after a change, when nothing changed since the last call: a program may still be writing.
    // Call it a few times a second.
    bool changed();
    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Times times() const;

    std::vector<std::filesystem::path> files_;
    Times known_, last_;
};

}  // namespace diptych::viewer
