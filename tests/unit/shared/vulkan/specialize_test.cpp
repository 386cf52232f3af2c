// SPDX-License-Identifier: MIT
// Specialised modules, compared with SPIRV-Tools as an independent implementation. Its validator accepts
// them, and its slower optimiser gives the same result for the module with the same values.
#include "shared/vulkan/specialize.h"
#include "shared/vulkan/shader_interface.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/features.h"
#include "shared/contract/material.h"
#include "shared/contract/posing.h"
#include "shared/vulkan/flatten.h"
#include "shared/vulkan/spirv.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.h>
#include <tbb/parallel_for.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <bit>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace diptych {
namespace {

using SpirvWords = std::vector<std::uint32_t>;
using FeatureValues = std::vector<std::uint32_t>;  // by feature id

constexpr spv_target_env spirvEnvironment = SPV_ENV_VULKAN_1_3;

SpirvWords specializedBy(std::span<const std::uint32_t> module, const FeatureValues& values,
                         const std::optional<std::set<std::uint32_t>>& outputs = {}) {
    return specialized(
        module, [&](std::uint32_t id) { return values.at(id); }, outputs);
}

// The validator's messages; empty for a valid module.
std::string complaint(const SpirvWords& words) {
    spvtools::SpirvTools tools(spirvEnvironment);
    std::string said;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { said += std::string(message) + "\n"; });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    if (!tools.Validate(words.data(), words.size(), options) && said.empty()) said = "not valid";
    return said;
}

// The module after SPIRV-Tools' optimiser, with these values.
SpirvWords optimised(std::span<const std::uint32_t> module, const FeatureValues& values) {
    spvtools::Optimizer optimizer(spirvEnvironment);
    std::unordered_map<std::uint32_t, SpirvWords> given;
    for (std::uint32_t id = 0; id < values.size(); ++id) given[id] = {values[id]};
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(given));
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
        // address, and, or. OpCopyObject computes nothing.
        const bool copies =
            op == 400 || op == 61 || op == 65 || op == 124 || op == 83 || op == 166 || op == 167;
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

// Feature values that a scene may need, most of them off, and others that no scene needs.
FeatureValues featureValues(std::uint32_t seed) {
    FeatureValues values(gpu::FEATURE_COUNT);
    if (seed == 0) return values;
    std::mt19937 random(seed);
    for (std::uint32_t& value : values)
        if (random() % 3 == 0) value = static_cast<std::uint32_t>(random() % (seed % 2 == 0 ? 2 : 9));
    return values;
}

SpirvWords assembled(const std::string& text) {
    spvtools::SpirvTools tools(spirvEnvironment);
    SpirvWords words;
    EXPECT_TRUE(tools.Assemble(text, &words, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS));
    return words;
}
std::string disassembled(const SpirvWords& words) {
    spvtools::SpirvTools tools(spirvEnvironment);
    std::string text;
    EXPECT_TRUE(tools.Disassemble(words, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER));
    return text;
}

// A fragment shader with specialization constants 0 and 1 (%number and %flag), the input %x and the output
// %out.
SpirvWords fragmentShader(const std::string& body) {
    return assembled(R"(OpCapability Shader
%ext = OpExtInstImport "GLSL.std.450"
OpMemoryModel Logical GLSL450
OpEntryPoint Fragment %main "main" %in %out
OpExecutionMode %main OriginUpperLeft
OpDecorate %in Location 0
OpDecorate %out Location 0
OpDecorate %number SpecId 0
OpDecorate %flag SpecId 1
OpDecorate %y NoContraction
%void = OpTypeVoid
%function = OpTypeFunction %void
%bool = OpTypeBool
%uint = OpTypeInt 32 0
%float = OpTypeFloat 32
%pin = OpTypePointer Input %float
%pout = OpTypePointer Output %float
%number = OpSpecConstant %uint 5
%flag = OpSpecConstantFalse %bool
%0u = OpConstant %uint 0
%1u = OpConstant %uint 1
%one = OpConstant %float 1
%in = OpVariable %pin Input
%out = OpVariable %pout Output
%main = OpFunction %void None %function
%entry = OpLabel
%x = OpLoad %float %in
%y = OpFMul %float %x %x
%is0 = OpIEqual %bool %number %0u
)" + body + "OpFunctionEnd\n");
}
std::string specializedText(const SpirvWords& words, std::uint32_t number, std::uint32_t flag) {
    const SpirvWords result = specializedBy(words, {number, flag});
    EXPECT_EQ(complaint(words), "");
    EXPECT_EQ(complaint(result), "") << disassembled(result);
    return disassembled(result);
}
std::size_t countOf(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
}

// Runs `judge` on each module with these values, on all cores. Returns its messages with module name and
// seed.
std::string ofEveryModule(
    std::uint32_t first, std::uint32_t end,
    const std::function<std::string(const ShaderModule&, const FeatureValues&)>& judge) {
    const auto modules = shaderModules();
    std::vector<std::string> said(modules.size());
    tbb::parallel_for(std::size_t{0}, modules.size(), [&](std::size_t i) {
        for (std::uint32_t seed = first; seed < end; ++seed)
            if (const std::string words = judge(modules[i], featureValues(seed)); !words.empty())
                said[i] += fmt::format("{}, seed {}: {}\n", modules[i].name, seed, words);
    });
    return fmt::format("{}", fmt::join(said, ""));
}

TEST(Specialize, EveryModuleStaysValid) {
    EXPECT_EQ(ofEveryModule(0, 20,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                return complaint(specializedBy(module.words, values));
                            }),
              "");
}

// An id in the code that no earlier instruction defines; 0 if there is none. A block's predecessors are
// written above it, so every dominating block is, too.
std::uint32_t madeBelow(const SpirvWords& words) {
    struct Walk {
        std::vector<bool> made;
        bool inside = false;
        std::uint32_t fault = 0;
    } walk{std::vector<bool>(words[3]), false, 0};
    const auto take = [](void* data, const spv_parsed_instruction_t* in) {
        Walk& w = *static_cast<Walk*>(data);
        w.inside |= in->opcode == 54;                              // OpFunction
        const bool goes = in->opcode >= 245 && in->opcode <= 249;  // OpPhi to OpBranch
        const std::uint16_t end = in->opcode == 250 || in->opcode == 251 ? 1 : in->num_operands;
        for (std::uint16_t i = 0; w.inside && !goes && i < end; ++i) {
            const spv_parsed_operand_t& operand = in->operands[i];
            const std::uint32_t word = in->words[operand.offset];
            if (operand.type == SPV_OPERAND_TYPE_ID && !w.made[word] && w.fault == 0) w.fault = word;
        }
        if (in->result_id != 0) w.made[in->result_id] = true;
        return SPV_SUCCESS;
    };
    spvtools::Context context(spirvEnvironment);
    EXPECT_EQ(spvBinaryParse(context.CContext(), &walk, words.data(), words.size(), nullptr, take, nullptr),
              SPV_SUCCESS);
    return walk.fault;
}

// Takes a tenth of the validator's time for hundreds of values. With blocks in the module's own order,
// seed 27 left gbuffer.frag with ids defined further below.
TEST(Specialize, WhatTheCodeNamesIsMadeAbove) {
    EXPECT_EQ(ofEveryModule(20, 300,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                const std::uint32_t id = madeBelow(specializedBy(module.words, values));
                                return id == 0 ? std::string() : fmt::format("%{} is made below", id);
                            }),
              "");
}

TEST(Specialize, LeavesWhatTheOptimiserLeaves) {
    EXPECT_EQ(ofEveryModule(0, 4,
                            [](const ShaderModule& module, const FeatureValues& values) {
                                const auto theirs = computations(optimised(module.words, values));
                                const SpirvWords ours = specializedBy(module.words, values);
                                return std::string(computations(optimised(ours, values)) == theirs
                                                       ? ""
                                                       : "other computations");
                            }),
              "");
}

// SPIRV-Tools finds no more inputs, outputs or bindings that the code does not use.
TEST(Specialize, LeavesNoInterfaceThatTheCodeDoesNotName) {
    EXPECT_EQ(ofEveryModule(0, 12,
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

TEST(Specialize, LeavesOutInputsThatNothingReads) {
    const SpirvWords words = fragmentShader(R"(
%either = OpSelect %float %is0 %y %one
OpSelectionMerge %after None
OpBranchConditional %is0 %then %after
%then = OpLabel
OpStore %out %either
OpBranch %after
%after = OpLabel
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 0, 0), "Input"), 2u);  // the pointer's type and the variable
    EXPECT_EQ(countOf(specializedText(words, 1, 0), "Input"), 0u);
    EXPECT_EQ(inputLocations(specializedBy(words, {0, 0})), std::set<std::uint32_t>{0});
    EXPECT_EQ(inputLocations(specializedBy(words, {1, 0})), std::set<std::uint32_t>{});
}

// Each column of a matrix has its own location.
TEST(Specialize, InputsOfMatricesHaveALocationAColumn) {
    const std::set<std::uint32_t> all = inputLocations(shaderModule(Shader::surface_vert).words);
    for (std::uint32_t location = 0; location <= 15; ++location)
        EXPECT_TRUE(all.contains(location)) << location;
}

// Each element of an array, too: the slots' texture coordinates, two slots each, begin at 7.
TEST(Specialize, InputsOfArraysHaveALocationAnElement) {
    const std::set<std::uint32_t> all = inputLocations(shaderModule(Shader::forward_shade_frag).words);
    for (std::uint32_t location = 0; location < 7 + gpu::SLOT_COUNT / 2; ++location)
        EXPECT_TRUE(all.contains(location)) << location;
    EXPECT_FALSE(all.contains(7 + gpu::SLOT_COUNT / 2));
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
    EXPECT_EQ(outputs(all), 6);  // without slots and vertex lights
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

// After losing an edge, a block may depend on one below it: %second then only follows %first.
TEST(Specialize, ABlockStandsBelowThoseThatLeadToIt) {
    const SpirvWords words = fragmentShader(R"(
OpSelectionMerge %after None
OpSwitch %number %other 1 %first 2 %second
%second = OpLabel
%either = OpPhi %float %y %entry %sum %first
OpStore %out %either
OpBranch %after
%first = OpLabel
%sum = OpFAdd %float %x %one
OpBranch %second
%other = OpLabel
OpBranch %after
%after = OpLabel
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 1, 0), "OpFAdd"), 1u);
    EXPECT_EQ(countOf(specializedText(words, 2, 0), "OpFAdd"), 0u);
    EXPECT_EQ(madeBelow(specializedBy(words, {1, 0})), 0u);
}

TEST(Specialize, TakesOneSideOfABranch) {
    const SpirvWords words = fragmentShader(R"(
OpSelectionMerge %after None
OpBranchConditional %is0 %then %else
%then = OpLabel
%sum = OpFAdd %float %y %one
OpBranch %after
%else = OpLabel
%root = OpExtInst %float %ext Sqrt %x
OpBranch %after
%after = OpLabel
%both = OpPhi %float %sum %then %root %else
OpStore %out %both
OpReturn
)");
    const std::string with0 = specializedText(words, 0, 0), with1 = specializedText(words, 1, 0);
    EXPECT_EQ(countOf(with0, "OpFAdd"), 1u);
    EXPECT_EQ(countOf(with0, "Sqrt"), 0u);
    EXPECT_EQ(countOf(with0, "NoContraction"), 1u);
    EXPECT_EQ(countOf(with1, "OpFAdd"), 0u);
    EXPECT_EQ(countOf(with1, "OpFMul"), 0u) << "what nothing reads any more is still made";
    EXPECT_EQ(countOf(with1, "NoContraction"), 0u);
    EXPECT_EQ(countOf(with1, "Sqrt"), 1u);
    for (const std::string& text : {with0, with1}) {
        EXPECT_EQ(countOf(text, "OpBranchConditional"), 0u);
        EXPECT_EQ(countOf(text, "SpecId"), 0u);
        EXPECT_EQ(countOf(text, "OpSpecConstant"), 0u);
    }
}

// A loop that ends in its first iteration keeps its continue target; a loop without iterations has no
// body.
TEST(Specialize, ALoopThatDoesNotGoRoundIsStillOne) {
    const SpirvWords words = fragmentShader(R"(
OpBranch %loop
%loop = OpLabel
%i = OpPhi %uint %0u %entry %next %again
%sum = OpPhi %float %x %entry %more %again
OpLoopMerge %after %again None
OpBranch %test
%test = OpLabel
%goes = OpULessThan %bool %i %number
OpBranchConditional %goes %body %after
%body = OpLabel
%more = OpFAdd %float %sum %y
OpSelectionMerge %on None
OpBranchConditional %flag %leave %on
%leave = OpLabel
OpBranch %after
%on = OpLabel
OpBranch %again
%again = OpLabel
%next = OpIAdd %uint %i %1u
OpBranch %loop
%after = OpLabel
%end = OpPhi %float %sum %test %more %leave
OpStore %out %end
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 3, 0), "OpFAdd"), 1u);
    const std::string once = specializedText(words, 3, 1), never = specializedText(words, 0, 0);
    EXPECT_EQ(countOf(once, "OpFAdd"), 1u);
    EXPECT_EQ(countOf(once, "OpIAdd"), 0u);
    EXPECT_EQ(countOf(once, "OpUndef"), 2u);
    EXPECT_EQ(countOf(never, "OpFAdd"), 0u);
    EXPECT_EQ(countOf(never, "OpULessThan"), 0u);
}

// After the outer condition is decided, a branch out of its construct gets its own merge block.
TEST(Specialize, ABranchOutOfWhatIsDecidedHasItsOwnMerge) {
    const SpirvWords words = fragmentShader(R"(
%small = OpFOrdLessThan %bool %x %one
OpSelectionMerge %after None
OpBranchConditional %is0 %then %after
%then = OpLabel
OpBranchConditional %small %more %after
%more = OpLabel
OpStore %out %y
OpBranch %after
%after = OpLabel
OpReturn
)");
    const std::string with0 = specializedText(words, 0, 0), with1 = specializedText(words, 1, 0);
    EXPECT_EQ(countOf(with0, "OpSelectionMerge"), 1u);
    EXPECT_EQ(countOf(with0, "OpStore"), 1u);
    EXPECT_EQ(countOf(with1, "OpStore"), 0u);
}

// A construct keeps its merge block even if nothing reaches it.
TEST(Specialize, AConstructKeepsItsEnd) {
    const SpirvWords words = fragmentShader(R"(
%small = OpFOrdLessThan %bool %x %one
OpSelectionMerge %after None
OpBranchConditional %small %a %b
%a = OpLabel
OpReturn
%b = OpLabel
OpSelectionMerge %c None
OpBranchConditional %flag %d %c
%d = OpLabel
OpReturn
%c = OpLabel
OpBranch %after
%after = OpLabel
OpStore %out %y
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 0, 0), "OpStore"), 1u);
    const std::string never = specializedText(words, 0, 1);
    EXPECT_EQ(countOf(never, "OpStore"), 0u);
    EXPECT_EQ(countOf(never, "OpUnreachable"), 1u);
}

// A phi takes its value from the remaining predecessors, and this value decides the branches that depend
// on it.
TEST(Specialize, WhatIsLeftOfSeveralSidesDecides) {
    const SpirvWords words = fragmentShader(R"(
OpSelectionMerge %after None
OpBranchConditional %is0 %then %after
%then = OpLabel
OpBranch %after
%after = OpLabel
%which = OpPhi %bool %flag %then %is0 %entry
%factor = OpSelect %float %which %y %one
OpStore %out %factor
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 0, 1), "OpFMul"), 1u);
    EXPECT_EQ(countOf(specializedText(words, 0, 0), "OpFMul"), 0u);
    EXPECT_EQ(countOf(specializedText(words, 1, 1), "OpFMul"), 0u);
}

// A switch stays a switch with its single case, because branches out of it need it.
TEST(Specialize, ASwitchKeepsItsCase) {
    const SpirvWords words = fragmentShader(R"(
OpSelectionMerge %after None
OpSwitch %number %other 1 %first 7 %second
%first = OpLabel
OpStore %out %x
OpBranch %after
%second = OpLabel
OpStore %out %y
OpBranch %after
%other = OpLabel
OpBranch %after
%after = OpLabel
%flagged = OpSelect %float %flag %one %y
OpStore %out %flagged
OpReturn
)");
    EXPECT_EQ(countOf(specializedText(words, 1, 0), "OpStore"), 2u);
    EXPECT_EQ(countOf(specializedText(words, 7, 0), "OpFMul"), 1u);
    const std::string other = specializedText(words, 3, 1);
    EXPECT_EQ(countOf(other, "OpStore"), 1u);
    EXPECT_EQ(countOf(other, "OpFMul"), 0u) << "what a known condition does not select is still made";
    EXPECT_EQ(countOf(other, "OpSwitch"), 1u);
}

TEST(Specialize, WhatIsNoSuchModuleIsRefused) {
    EXPECT_THROW(specializedBy(std::vector<std::uint32_t>{1, 2, 3}, {}), std::logic_error);
    SpirvWords none = fragmentShader("OpReturn\n");
    const SpirvWords two = assembled(R"(OpCapability Shader
OpMemoryModel Logical GLSL450
OpEntryPoint GLCompute %main "main"
OpExecutionMode %main LocalSize 1 1 1
%void = OpTypeVoid
%function = OpTypeFunction %void
%main = OpFunction %void None %function
%a = OpLabel
OpReturn
OpFunctionEnd
%other = OpFunction %void None %function
%b = OpLabel
OpReturn
OpFunctionEnd
)");
    EXPECT_THROW(specializedBy(two, {}), std::logic_error);
    none.resize(none.size() - 1);  // without its end
    EXPECT_THROW(specializedBy(none, {0, 0}), std::logic_error);
}

// Number of each instruction in a module.
std::map<std::uint32_t, int> instructionsOf(const SpirvWords& words) {
    std::map<std::uint32_t, int> count;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) ++count[words[at] & 0xffff];
    return count;
}

// Computations stay, each phi becomes a select, and there are fewer branches.
TEST(Flatten, EveryModuleComputesTheSameWithFewerBranches) {
    constexpr std::uint32_t select = 169, phi = 245, selectionMerge = 247, label = 248, branch = 249,
                            conditional = 250;
    int before = 0, after = 0;
    for (const ShaderModule& module : shaderModules()) {
        SCOPED_TRACE(std::string(module.name));
        const SpirvWords whole = specializedBy(module.words, featureValues(2)), flat = flattened(whole);
        ASSERT_EQ(complaint(flat), "");
        auto a = instructionsOf(whole), b = instructionsOf(flat);
        EXPECT_EQ(a[phi] - b[phi], b[select] - a[select]);
        EXPECT_EQ(a[conditional] - b[conditional], a[selectionMerge] - b[selectionMerge]);
        before += a[conditional], after += b[conditional];
        for (const std::uint32_t op : {select, phi, selectionMerge, label, branch, conditional})
            a.erase(op), b.erase(op);
        EXPECT_EQ(a, b);
    }
    EXPECT_LT(after, before * 2 / 3) << before;
}

// The condition selects the right side. A branch that reads memory stays, and so do those around it.
TEST(Flatten, SelectsTheSideOfTheConditionAndLeavesMemoryAlone) {
    const auto branches = [](const std::string& inner) {
        return flattened(specializedBy(fragmentShader(R"(%c = OpFOrdLessThan %bool %x %one
OpSelectionMerge %end None
OpBranchConditional %c %yes %no
%yes = OpLabel
%a = OpFAdd %float %x %one
OpBranch %end
%no = OpLabel
)" + inner + R"(OpBranch %end
%end = OpLabel
%r = OpPhi %float %b %no %a %yes
OpStore %out %r
OpReturn
)"),
                                       {1, 0}));
    };
    const std::string flat = disassembled(branches("%b = OpFMul %float %x %x\n"));
    EXPECT_EQ(flat.find("OpPhi"), flat.npos) << flat;
    const auto nameOf = [&](const std::string& made) {  // of the result of the only such instruction
        const std::size_t at = flat.rfind(" = " + made);
        return flat.substr(flat.rfind('\n', at) + 1, at - flat.rfind('\n', at) - 1);
    };
    const std::string sum = nameOf("OpFAdd"), product = nameOf("OpFMul"), less = nameOf("OpFOrdLessThan");
    const std::string trimmed = flat.substr(flat.find("OpSelect "));
    const auto word = [](std::string text) { return text.substr(text.find('%')); };
    EXPECT_NE(trimmed.find(word(less) + " " + word(sum) + " " + word(product)), flat.npos) << flat;
    const std::string kept = disassembled(branches("%b = OpLoad %float %in\n"));
    EXPECT_NE(kept.find("OpPhi"), kept.npos) << kept;
    EXPECT_EQ(kept.find("OpSelect "), kept.npos) << kept;
}

}  // namespace
}  // namespace diptych
