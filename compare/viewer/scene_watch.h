// SPDX-License-Identifier: MIT
// Tells when the files of a scene change on disk.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace diptych::viewer {

class SceneWatch {
public:
    // The files of a scene: its own, those that a .gltf names, and `others`, an environment or a file of
    // lights. A built-in scene has none.
    void watch(const std::string& scene, const std::vector<std::filesystem::path>& others);
    // True once after a change, as soon as nothing more has changed since the last call: a program may still
    // be writing. To be called a few times a second.
    bool changed();
    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Times times() const;

    std::vector<std::filesystem::path> files_;
    Times known_, last_;
};

}  // namespace diptych::viewer
