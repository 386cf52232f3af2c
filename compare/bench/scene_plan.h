// SPDX-License-Identifier: MIT
// The result of `plan` for a scene.
#pragma once

#include "compare/render/compiled_plan.h"
#include "compare/render/frame_work.h"
#include "compare/render/path_plan.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace diptych::bench {

struct ScenePlan {
    std::string scene;
    Requirements needs;
    std::vector<Requirements::Line> lines;
    std::vector<std::string> notes;  // deviations from the glTF file
    std::vector<std::string> variants;
    int variant = -1;  // the drawn one; -1: none
    std::vector<PathPlan> paths;
    std::vector<FrameWork> work;         // with --estimate
    std::vector<CompiledPath> compiled;  // with --compile-on
    const DeviceInfo* compiler = nullptr;
};
std::string describe(const ScenePlan& plan);
nlohmann::ordered_json toJson(const ScenePlan& plan);

}  // namespace diptych::bench
