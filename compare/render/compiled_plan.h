// SPDX-License-Identifier: MIT
// Compiles the pipelines of both paths' frames and captures for a GPU that is not there.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device_compiler.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct PlannedPipeline {
    std::string pass;       // that has asked for it first
    bool captures = false;  // of a capture, and of no frame
    std::string name;       // the shader that it is called by: "forward_shade.frag"
    std::string variant;    // the features that are on: "normal_texture shadows=2"
    CompiledPipeline compiled;
    std::optional<double> unlit_cycles{};  // ShaderCost::cycles without lights, where it has some

    // The last shader's, which names the pipeline; nullptr: it did not compile.
    const ShaderCost* cost() const {
        return compiled.shaders.empty() ? nullptr : &compiled.shaders.back().cost;
    }
};

// The heaviest pipeline of a frame with a feature, and without it.
struct FeatureCost {
    std::string feature, pass, shader;
    ShaderCost with, without;
};

struct CompiledPath {
    Path path = Path::deferred;
    std::vector<PlannedPipeline> pipelines;
    std::vector<FeatureCost> features;  // those that change anything
    std::vector<std::string> errors;    // what does not compile or asks for more than there is, a line each
    std::vector<std::string> warnings;  // what spills
};

// Pipelines are compiled for the compiler of `device`; nothing is drawn.
std::vector<CompiledPath> compilePaths(Device& device, DeviceCompiler& compiler, SceneViews& views,
                                       const std::vector<Settings>& settings);

// Fills errors and warnings.
void judge(CompiledPath& path);

// The features of the variant that are on.
std::string inWords(const Variant& variant);

}  // namespace diptych
