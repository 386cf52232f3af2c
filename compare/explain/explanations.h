// SPDX-License-Identifier: MIT
// Explanations of lit differences, for a report.
#pragma once

#include "compare/image/channel_image.h"
#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"
#include "shared/frame/sides.h"
#include "shared/vulkan/device/device.h"

#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Whether any comparison is explained: with `all` every one, else those whose lit fails.
bool isExplained(bool all, const Report& report);

// The comparisons to explain, and how.
struct ExplanationQuestion {
    bool all = false;   // explain lit even where it passes
    Settings settings;  // of the scene's variant and environment
    SideSettings sides;
    RenderOptions drawing;
    ImageChoice image;
};
// Adds explanations; verdicts do not change. A comparison that cannot be explained gets the reason.
void addExplanations(const ExplanationQuestion& question, Device& device, Report& report,
                     const Stage& progress);

// Words of the command that explains a scene. The test is the other path or `test`, compared with
// `baseline`.
std::vector<std::string> explainArguments(const std::string& scene, const Settings& settings, Path baseline,
                                          const std::vector<std::pair<std::string, std::string>>& test);

}  // namespace diptych
