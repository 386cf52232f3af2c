// SPDX-License-Identifier: MIT
// Modules for tests of the code that changes SPIR-V, and SPIRV-Tools as an independent judge of the results.
#pragma once

#include "shared/contract/features.h"
#include "shared/vulkan/spirv/specialize.h"

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.h>
#include <spirv-tools/libspirv.hpp>

#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace diptych {

using SpirvWords = std::vector<std::uint32_t>;
using FeatureValues = std::vector<std::uint32_t>;  // by feature id

inline constexpr spv_target_env spirvEnvironment = SPV_ENV_VULKAN_1_3;

inline SpirvWords specializedBy(std::span<const std::uint32_t> module, const FeatureValues& values,
                                const std::optional<std::set<std::uint32_t>>& outputs = {}) {
    return specialized(
        module, [&](std::uint32_t id) { return values.at(id); }, outputs);
}

// The validator's messages; empty for a valid module.
inline std::string complaint(const SpirvWords& words) {
    spvtools::SpirvTools tools(spirvEnvironment);
    std::string said;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { said += std::string(message) + "\n"; });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    if (!tools.Validate(words.data(), words.size(), options) && said.empty()) said = "not valid";
    return said;
}

// Feature values that a scene may need, most of them off, and others that no scene needs.
inline FeatureValues featureValues(std::uint32_t seed) {
    FeatureValues values(gpu::FEATURE_COUNT);
    if (seed == 0) return values;
    std::mt19937 random(seed);
    for (std::uint32_t& value : values)
        if (random() % 3 == 0) value = static_cast<std::uint32_t>(random() % (seed % 2 == 0 ? 2 : 9));
    return values;
}

inline SpirvWords assembled(const std::string& text) {
    spvtools::SpirvTools tools(spirvEnvironment);
    SpirvWords words;
    EXPECT_TRUE(tools.Assemble(text, &words, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS));
    return words;
}
inline std::string disassembled(const SpirvWords& words) {
    spvtools::SpirvTools tools(spirvEnvironment);
    std::string text;
    EXPECT_TRUE(tools.Disassemble(words, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER));
    return text;
}

// An id in the code that no earlier instruction defines; 0 if there is none. A block's predecessors are
// written above it, so every dominating block is, too.
inline std::uint32_t madeBelow(const SpirvWords& words) {
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

// A fragment shader with specialization constants 0 and 1 (%number and %flag), the input %x and the output
// %out.
inline SpirvWords fragmentShader(const std::string& body) {
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

}  // namespace diptych
