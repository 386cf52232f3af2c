// SPDX-License-Identifier: MIT
// Compiler statistics of both paths' pipelines, as text and JSON.
#pragma once

#include "compare/render/compiled_plan.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace diptych::bench {

// Table with one row per shader and pass, the paths side by side: number of pipelines and the heaviest
// one. Below it: the cost of each feature, and problems.
std::string compiledText(std::span<const CompiledPath> paths, const DeviceInfo& device);

// The changed statistics: "+38 VGPRs, occupancy 16 -> 10, +2,048 bytes".
std::string addedText(const FeatureCost& cost);

nlohmann::ordered_json compiledJson(std::span<const CompiledPath> paths, const DeviceInfo& device);

}  // namespace diptych::bench
