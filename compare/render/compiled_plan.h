// SPDX-License-Identifier: MIT
// Compiles the pipelines of both paths' frames and captures for a GPU that need not be present.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/pipelines/device_compiler.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct PlannedPipeline {
    std::string pass;       // the first that requested it
    bool captures = false;  // only a capture uses it
    std::string name;       // the shader that names it: "forward_shade.frag"
    std::string variant;    // enabled features: "normal_texture shadows=2"
    CompiledPipeline compiled;
    std::optional<double> unlit_cycles{};  // ShaderCost::cycles without lights, if it evaluates any

    // Cost of the last shader, which names the pipeline; nullptr if it did not compile.
    const ShaderCost* cost() const {
        return compiled.shaders.empty() ? nullptr : &compiled.shaders.back().cost;
    }
};

// The heaviest pipeline of a frame that uses a feature, with and without it.
struct FeatureCost {
    std::string feature, pass, shader;
    ShaderCost with, without;
};

struct CompiledPath {
    Path path = Path::deferred;
    std::vector<PlannedPipeline> pipelines;
    std::vector<FeatureCost> features;  // features that change anything
    std::vector<std::string> errors;    // compile errors and exceeded device limits, a line each
    std::vector<std::string> warnings;  // register spills
};

// Compiles for the compiler of `device`; renders nothing.
std::vector<CompiledPath> compilePaths(Device& device, DeviceCompiler& compiler, SceneViews& views,
                                       const std::vector<Settings>& settings);

// Fills errors and warnings.
void evaluate(CompiledPath& path);

// The enabled features of the variant.
std::string describe(const Variant& variant);

}  // namespace diptych
