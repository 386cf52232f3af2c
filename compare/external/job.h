// SPDX-License-Identifier: MIT
// Input of an external renderer: one JSON file per image, and the files that it names.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::external {

struct Job {
    std::string text;                // the JSON on one line: the last argument
    std::filesystem::path file;      // the JSON as a file
    std::filesystem::path image;     // output
    std::vector<std::string> notes;  // scene features that it cannot express, one line each
};

// Writes job.json and rig.glb into `folder`. With an environment adds environment.exr, and background.exr
// if the visible one differs. Adds scene.glb if the scene is not a file or the renderer requests a copy.
// `folder` is empty and absolute; the caller owns it. `settings`: of our image. The format is
// compare/external/job.schema.json. Throws std::runtime_error, one line.
Job writeJob(const std::filesystem::path& folder, const Scene& scene, const SceneView& view,
             const Settings& settings, const ExternalRenderer& renderer);

}  // namespace diptych::external
