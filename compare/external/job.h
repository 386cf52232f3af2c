// SPDX-License-Identifier: MIT
// What another renderer is told: one JSON file of one picture, and the files that it names.
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
    std::string text;                // the JSON, on one line: the last argument
    std::filesystem::path file;      // the same as a file
    std::filesystem::path picture;   // that is to be written
    std::vector<std::string> notes;  // what of the scene it cannot say, one line each
};

// Writes into `folder`, which is empty, absolute and remains the caller's: job.json, rig.glb, where there is
// an environment environment.exr (and background.exr, where the one that is seen is another), and scene.glb
// where the scene is no file of its own or the renderer asks for a copy. `settings`: of the picture that ours
// is compared with. compare/external/job.schema.json describes the text. Throws std::runtime_error, one line.
Job writeJob(const std::filesystem::path& folder, const Scene& scene, const SceneView& view,
             const Settings& settings, const Renderer& renderer);

}  // namespace diptych::external
