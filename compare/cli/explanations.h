// SPDX-License-Identifier: MIT
// Why lit differs, for a report.
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

// Whether some comparison gets an explanation: with --explain all do, else those whose lit fails.
bool isExplained(const Options& options, const Report& report);

// Adds them. Verdicts stay as they are. What cannot be explained says why.
void addExplanations(const Options& options, Device& device, Report& report, const Stage& progress);

// The words of the command line that explains a scene: the other path, or what `test` names, against
// `baseline`.
std::vector<std::string> explainWords(const std::string& scene, const Settings& settings, Path baseline,
                                      const std::vector<std::pair<std::string, std::string>>& test);

// Another renderer's picture of the view of `ours`, as explain() takes it: with the Settings and the channels
// of `ours` where it says nothing of them, so that what its lit differs by is sought in the lighting. Where
// ours comes nearer to it with normals of skins turned otherwise (--skin-normals) or roughness that is
// widened by normals (--spec-aa), those are the channels.
Frame lentChannels(const Frame& external, const Frame& ours, Renderer& renderer,
                   const RenderOptions& options);

}  // namespace diptych::cli
