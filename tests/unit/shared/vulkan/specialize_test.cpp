// SPDX-License-Identifier: MIT
// Specialised shipped modules, compared with SPIRV-Tools as an independent implementation. Its validator
// accepts them, and its slower optimiser gives the same result for the module with the same values.
#include "shared/vulkan/spirv/specialize.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/features.h"
#include "shared/contract/material.h"
#include "shared/contract/posing.h"
#include "shared/vulkan/spirv/shader_interface.h"
#include "shared/vulkan/spirv/spirv.h"
#include "tests/support/campaign.h"
#include "tests/support/spirv_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <spirv-tools/optimizer.hpp>

#include <bit>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace diptych {
namespace {

// The module after SPIRV-Tools' optimiser, with these values.
SpirvWords optimised(std::span<const std::uint32_t> module, const FeatureValues& values) {
    spvtools::Optimizer optimizer(spirvEnvironment);
    std::unordered_map<std::uint32_t, SpirvWords> constants;
    for (std::uint32_t id = 0; id < values.size(); ++id) constants[id] = {values[id]};
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(constants));
    // Several rounds, because each finds more dead code after the previous one.
    const std::vector<std::string> begin{"--strip-debug", "--freeze-spec-const",
                                         "--fold-spec-const-op-composite"};
    const std::vector<std::string> round{
        "--ccp",        "--simplify-instructions",         "--eliminate-dead-branches", "--merge-blocks",
        "--vector-dce", "--eliminate-dead-code-aggressive"};
    EXPECT_TRUE(optimizer.RegisterPassesFromFlags(begin));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(optimizer.RegisterPassesFromFlags(round));
    SpirvWords small;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // it lacks scalar block layout
    EXPECT_TRUE(optimizer.Run(module.data(), module.size(), &small, options));
    return small;
}

// Number of each instruction in a module's functions, except control flow.
std::map<std::string, int> computations(const SpirvWords& small) {
    std::map<std::string, int> instructions;
    bool inside = false;
    for (std::size_t at = 5; at < small.size(); at += small[at] >> 16) {
        const std::uint32_t op = small[at] & 0xffff;
        inside |= op == 54;                        // OpFunction
        const bool goes = op >= 245 && op <= 255;  // OpPhi to OpUnreachable
        // The optimiser keeps every OpCopyLogical and its operands: OpLoad, OpAccessChain, OpBitcast of an
        // address, and, or. It keeps a shift by the counter of a loop that runs once. OpCopyObject computes
        // nothing.
        const bool copies =
            op == 400 || op == 61 || op == 65 || op == 124 || op == 83 || op == 166 || op == 167 || op == 194;
        if (!inside || goes || copies) continue;
        const std::uint32_t extended = op == 12 ? small[at + 4] : 0;  // OpExtInst
        ++instructions[fmt::format("{}.{}", op, extended)];
    }
    return instructions;
}

// A module's interface: number of inputs, outputs and bindings, by storage class and location, or set and
// binding.
std::map<std::string, int> interfaceOf(const SpirvWords& words) {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> decorations;
    std::map<std::string, int> found;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
        const std::uint32_t op = words[at] & 0xffff;
        if (op == 54) break;  // OpFunction
        if (op == 71)
            decorations[words[at + 1]][words[at + 2]] =  // OpDecorate
                words[at] >> 16 > 3 ? words[at + 3] : 1;
        if (op != 59) continue;  // OpVariable
        auto& of = decorations[words[at + 2]];
        constexpr std::uint32_t location = 30, binding = 33, set = 34, built_in = 11;
        ++found[fmt::format("class {} location {} set {} binding {} built in {}", words[at + 3],
                            of.contains(location) ? of[location] : 99, of[set], of[binding], of[built_in])];
    }
    return found;
}

// Runs `evaluate` on each module with these values, on all cores. Returns its messages with module name and
// seed.
std::string ofEveryModule(
    std::uint32_t first, std::uint32_t end,
    const std::function<std::string(const ShaderModule&, const FeatureValues&)>& evaluate) {
    const auto modules = shaderModules();
    std::vector<std::string> said(modules.size());
    tbb::parallel_for(std::size_t{0}, modules.size(), [&](std::size_t i) {
        for (std::uint32_t seed = first; seed < end; ++seed)
            if (const std::string words = evaluate(modules[i], featureValues(seed)); !words.empty())
                said[i] += fmt::format("{}, seed {}: {}\n", modules[i].name, seed, words);
    });
    return fmt::format("{}", fmt::join(said, ""));
}

TEST(Specialize, EveryModuleStaysValid) {
    EXPECT_EQ(ofEveryModule(0, isCampaign() ? 8 : 4,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                return complaint(specializedBy(module.words, values));
                            }),
              "");
}

// Takes a tenth of the validator's time, for hundreds of values in a campaign. With blocks in the module's
// own order, seed 27 left gbuffer.frag with ids defined further below.
TEST(Specialize, WhatTheCodeNamesIsMadeAbove) {
    EXPECT_EQ(ofEveryModule(8, isCampaign() ? 300 : 48,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                const std::uint32_t id = madeBelow(specializedBy(module.words, values));
                                return id == 0 ? std::string() : fmt::format("%{} is made below", id);
                            }),
              "");
}

// Tiles are classified of G-buffers with layers alone. Without them its loops compute nothing, and one of
// both leaves an `or` with 0.
TEST(Specialize, LeavesWhatTheOptimiserLeaves) {
    EXPECT_EQ(ofEveryModule(
                  1, isCampaign() ? 5 : 3,
                  [](const ShaderModule& module, const FeatureValues& values) {
                      if (module.name == "deferred_tiles.comp" && values[gpu::FEATURE_gbuffer_layers] == 0)
                          return std::string();
                      const auto theirs = computations(optimised(module.words, values));
                      const SpirvWords ours = specializedBy(module.words, values);
                      return std::string(
                          computations(optimised(ours, values)) == theirs ? "" : "other computations");
                  }),
              "");
}

// SPIRV-Tools finds no more inputs, outputs or bindings that the code does not use.
TEST(Specialize, LeavesNoInterfaceThatTheCodeDoesNotName) {
    EXPECT_EQ(ofEveryModule(0, isCampaign() ? 4 : 2,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                const SpirvWords words = specializedBy(module.words, values);
                                spvtools::Optimizer optimizer(spirvEnvironment);
                                optimizer.RegisterPassesFromFlags(
                                    {"--remove-unused-interface-variables", "--eliminate-dead-variables"});
                                spvtools::OptimizerOptions options;
                                options.set_run_validator(false);  // it lacks scalar block layout
                                SpirvWords tidied;
                                EXPECT_TRUE(optimizer.Run(words.data(), words.size(), &tidied, options));
                                return std::string(interfaceOf(tidied) == interfaceOf(words)
                                                       ? ""
                                                       : "something is left that nothing names");
                            }),
              "");
}

// Each column of a matrix has its own location.
TEST(Specialize, InputsOfMatricesHaveALocationAColumn) {
    const std::set<std::uint32_t> all = inputLocations(shaderModule(Shader::surface_vert).words);
    for (std::uint32_t location = 0; location <= 15; ++location)
        EXPECT_TRUE(all.contains(location)) << location;
}

// Each element of an array, too: the slots' texture coordinates, two slots each, begin at 6.
TEST(Specialize, InputsOfArraysHaveALocationAnElement) {
    const std::set<std::uint32_t> all = inputLocations(shaderModule(Shader::forward_shade_frag).words);
    for (std::uint32_t location = 0; location < 6 + gpu::SLOT_COUNT / 2; ++location)
        EXPECT_TRUE(all.contains(location)) << location;
    EXPECT_FALSE(all.contains(6 + gpu::SLOT_COUNT / 2));
}

int outputs(const SpirvWords& of) {
    int count = 0;
    for (const auto& [name, found] : interfaceOf(of)) count += name.starts_with("class 3 ") ? found : 0;
    return count;
}

// A vertex shader stores what the fragment shader reads, and computes and fetches nothing else.
TEST(Specialize, StoresNoOutputThatNothingReads) {
    FeatureValues values(gpu::FEATURE_COUNT);
    const auto& words = shaderModule(Shader::surface_vert).words;
    const SpirvWords normals = specializedBy(words, values, std::set<std::uint32_t>{0}),
                     none = specializedBy(words, values, std::set<std::uint32_t>{}),
                     all = specializedBy(words, values);
    EXPECT_EQ(complaint(normals), "");
    EXPECT_EQ(complaint(none), "");
    const std::set<std::uint32_t> position{0, 5, 6, 7, 8}, normal{0, 1, 5, 6, 7, 8, 9, 10, 11};
    EXPECT_EQ(inputLocations(none), position);
    EXPECT_EQ(inputLocations(normals), normal);
    EXPECT_GT(inputLocations(all).size(), normal.size());
    EXPECT_EQ(outputs(none), 1);  // gl_Position
    EXPECT_EQ(outputs(normals), 2);
    EXPECT_EQ(outputs(all), 7);  // without slots and vertex lights; the first UV set is two
}

// Attachments are only the images that a capture draws, from the first location on.
TEST(Specialize, CapturesStoreTheImagesThatAreDrawn) {
    for (const Shader shader : {Shader::deferred_capture_frag, Shader::forward_capture_frag})
        for (const std::uint32_t images :
             {1u, 1u << 5, 1u | 1u << 3 | 1u << (gpu::CAPTURE_IMAGES - 1), 0xffu << 8}) {
            FeatureValues values(gpu::FEATURE_COUNT);
            values[gpu::FEATURE_captures] = images;
            EXPECT_EQ(outputs(specializedBy(shaderModule(shader).words, values)), std::popcount(images))
                << images;
        }
}

// A variant only requires optional device capabilities that it uses.
TEST(Specialize, LeavesOutCapabilitiesThatNothingDemands) {
    const auto has = [](Shader shader, std::uint32_t capability, std::map<std::uint32_t, std::uint32_t> on) {
        FeatureValues values(gpu::FEATURE_COUNT);
        for (const auto& [feature, value] : on) values.at(feature) = value;
        const SpirvWords words = specializedBy(shaderModule(shader).words, values);
        EXPECT_EQ(complaint(words), "");
        for (std::size_t at = 5; (words[at] & 0xffff) == 17; at += 2)  // OpCapability
            if (words[at + 1] == capability) return true;
        return false;
    };
    const gpu::uint lights = gpu::FEATURE_point_lights, half = gpu::FEATURE_half_shading;
    EXPECT_TRUE(has(Shader::forward_shade_frag, 9, {{lights, 1}, {half, 1}}));  // Float16
    EXPECT_FALSE(has(Shader::forward_shade_frag, 9, {{lights, 1}}));
    const gpu::uint joints = gpu::FEATURE_posed_joint_sets, parts = gpu::FEATURE_posed_parts;
    EXPECT_TRUE(has(Shader::pose_comp, 11, {{joints, 1}, {parts, gpu::POSED_PAIRS}}));  // Int64
    EXPECT_FALSE(has(Shader::pose_comp, 11, {{joints, 1}}));
    EXPECT_TRUE(has(Shader::deferred_shade_comp, 27, {{gpu::FEATURE_samples, 4}}));  // stored samples
    EXPECT_FALSE(has(Shader::deferred_shade_comp, 27, {}));
    EXPECT_TRUE(has(Shader::gbuffer_frag, 52, {}));  // interpolation at an offset; SwiftShader requires it
    EXPECT_TRUE(has(Shader::gbuffer_frag, 5379, {{gpu::FEATURE_alpha_mask, 1}}));  // helper invocations
    EXPECT_FALSE(has(Shader::gbuffer_frag, 5379, {}));
}

}  // namespace
}  // namespace diptych
