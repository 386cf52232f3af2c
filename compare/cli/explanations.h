// SPDX-License-Identifier: MIT
// Explanations of lit differences, for a report.
#pragma once

#include "compare/cli/options.h"
#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"
#include "shared/vulkan/device.h"

#include <string>
#include <utility>
#include <vector>

namespace diptych::cli {

// Whether any comparison is explained: all with --explain, else those whose lit fails.
bool isExplained(const Options& options, const Report& report);

// Adds explanations; verdicts do not change. A comparison that cannot be explained gets the reason.
void addExplanations(const Options& options, Device& device, Report& report, const Stage& progress);

// Words of the command that explains a scene. The test is the other path or `test`, compared with
// `baseline`.
std::vector<std::string> explainWords(const std::string& scene, const Settings& settings, Path baseline,
                                      const std::vector<std::pair<std::string, std::string>>& test);

// Another renderer's image of the view of `ours`, as input of explain(). Settings and channels that it
// does not declare come from `ours`, so lit differences are attributed to lighting. Tries other skin
// normals (--skin-normals) and widened roughness (--spec-aa), and takes the channels that bring lit
// closer.
Frame substituteChannels(const Frame& external, const Frame& ours, Renderer& renderer,
                         const RenderOptions& options);

}  // namespace diptych::cli
