// SPDX-License-Identifier: MIT
#include "compare/files/scene_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

bool isSceneFile(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".gltf" || ending == ".glb";
}

std::vector<std::string> sceneFilesIn(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const bool hidden = at->path().filename().string().starts_with('.');
        std::error_code ignored;
        if (hidden && at->is_directory(ignored)) at.disable_recursion_pending();
        if (!hidden && isSceneFile(at->path()) && at->is_regular_file(ignored))
            files.push_back(at->path().generic_string());
    }
    if (error) throw std::runtime_error(fmt::format("{}: {}", folder, error.message()));
    if (files.empty())
        throw std::runtime_error(
            fmt::format("{}: holds no .gltf or .glb file; name a folder that does, or a scene", folder));
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::vector<std::string> withFoldersOpened(const std::vector<std::string>& scenes) {
    std::vector<std::string> all;
    for (const std::string& scene : scenes) {
        std::error_code ignored;
        if (fs::is_directory(scene, ignored))
            std::ranges::move(sceneFilesIn(scene), std::back_inserter(all));
        else
            all.push_back(scene);
    }
    return all;
}

}  // namespace diptych
