// SPDX-License-Identifier: MIT
// A compiler's statistics of both paths' pipelines, as text and as JSON.
#pragma once

#include "compare/render/compiled_plan.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace diptych::cli {

// One row for each shader of each pass, the paths side by side: how many pipelines have it, and what is said
// of the heaviest. Below: what each feature adds, what is wrong.
std::string compiledText(std::span<const CompiledPath> paths, const DeviceInfo& device);

// "+38 VGPRs, occupancy 16 to 10, +2,048 bytes": what changes.
std::string addedInWords(const FeatureCost& cost);

nlohmann::ordered_json compiledJson(std::span<const CompiledPath> paths, const DeviceInfo& device);

}  // namespace diptych::cli
