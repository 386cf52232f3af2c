// SPDX-License-Identifier: MIT
// Both paths compute the same sums in different shaders. If a driver contracts a product and a sum to one
// operation in one shader only, they round differently. So every operation of every module is decorated
// NoContraction.
#include "shared/vulkan/spirv/spirv.h"
#include "tests/support/sources.h"
#include "tests/support/spirv_module.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using ModuleWords = std::vector<std::uint32_t>;
constexpr std::uint32_t opExtInst = 12, opDecorate = 71, opDot = 148, noContractionDecoration = 42;

ModuleWords wordsOf(const ShaderModule& module) {
    return {module.words.begin(), module.words.end()};
}

struct ExactRow {
    std::uint32_t op;
    std::string_view name;
    std::string_view why;  // why both paths get the same result without NoContraction
};

// Instructions with a float result that compute nothing. All others must be decorated.
constexpr std::string_view movesBits = "moves bits";
constexpr ExactRow exactInstructions[] = {
    {61, "OpLoad", movesBits},
    {77, "OpVectorExtractDynamic", movesBits},
    {79, "OpVectorShuffle", movesBits},
    {80, "OpCompositeConstruct", movesBits},
    {81, "OpCompositeExtract", movesBits},
    {82, "OpCompositeInsert", movesBits},
    {84, "OpTranspose", movesBits},
    {87, "OpImageSampleImplicitLod",
     "in material.glsl alone, on the same triangles and pixels in both paths"},
    {88, "OpImageSampleExplicitLod", "in one function, of the same bits"},
    {95, "OpImageFetch", movesBits},
    {96, "OpImageGather", movesBits},
    {111, "OpConvertSToF", "exact for integers below 2^24, and rounded to nearest beyond"},
    {112, "OpConvertUToF", "exact for integers below 2^24, and rounded to nearest beyond"},
    {115, "OpFConvert",
     "to floats of 32 bits exact, and to 16 rounded by what every module of a device does"},
    {124, "OpBitcast", movesBits},
    {169, "OpSelect", movesBits},
    {210, "OpDPdxFine", "in material.glsl alone, one difference of the same bits in both paths"},
    {211, "OpDPdyFine", "in material.glsl alone, one difference of the same bits in both paths"},
    {245, "OpPhi", movesBits},
    {355, "OpGroupNonUniformFMin", movesBits},
    {358, "OpGroupNonUniformFMax", movesBits},
};

// Instructions of GLSL.std.450, which cannot be decorated.
constexpr std::string_view isExact = "exact";
constexpr std::string_view oneFunction =
    "a function of one number, executed by both paths in the same function of shaders/lib: the same bits on "
    "lavapipe, and on a GPU whatever its unit for it gives";
constexpr ExactRow exactExtended[] = {
    {4, "FAbs", isExact},
    {8, "Floor", isExact},
    {9, "Ceil", isExact},
    {10, "Fract", "in probe_rounding.frag alone, which draws no picture"},
    {13, "Sin", oneFunction},
    {14, "Cos", oneFunction},
    {27, "Exp", oneFunction},
    {28, "Log", oneFunction},
    {29, "Exp2", oneFunction},
    {30, "Log2", oneFunction},
    {31, "Sqrt", oneFunction},
    {32, "InverseSqrt", oneFunction},
    {37, "FMin", isExact},
    {40, "FMax", isExact},
    {43, "FClamp", isExact},
    {78, "InterpolateAtOffset", "as any input is interpolated, at a place that both paths compute alike"},
};

const ExactRow* exactRowOf(const SpirvModule::Operation& operation) {
    const auto find = [](const auto& rows, std::uint32_t op) -> const ExactRow* {
        const auto found = std::ranges::find(rows, op, &ExactRow::op);
        return found == std::end(rows) ? nullptr : &*found;
    };
    return operation.op == opExtInst ? find(exactExtended, operation.extended)
                                     : find(exactInstructions, operation.op);
}

std::string operationName(const SpirvModule::Operation& operation) {
    static const std::map<std::uint32_t, std::string> names = {{127, "OpFNegate"},
                                                               {129, "OpFAdd"},
                                                               {131, "OpFSub"},
                                                               {133, "OpFMul"},
                                                               {136, "OpFDiv"},
                                                               {142, "OpVectorTimesScalar"},
                                                               {143, "OpMatrixTimesScalar"},
                                                               {144, "OpVectorTimesMatrix"},
                                                               {145, "OpMatrixTimesVector"},
                                                               {146, "OpMatrixTimesMatrix"},
                                                               {147, "OpOuterProduct"},
                                                               {opDot, "OpDot"}};
    if (operation.op == opExtInst) return fmt::format("instruction {} of GLSL.std.450", operation.extended);
    const auto found = names.find(operation.op);
    return found == names.end() ? fmt::format("opcode {}", operation.op) : found->second;
}

// Operations that may be contracted, with function and instruction.
Faults contractible(std::span<const std::uint32_t> words) {
    Faults faults;
    for (const SpirvModule::Operation& operation : SpirvModule(words).operations())
        if (!operation.no_contraction && !exactRowOf(operation))
            faults.push_back(
                fmt::format("{}: {} %{}", operation.function, operationName(operation), operation.result));
    return faults;
}

TEST(NoContraction, EveryOperationOfEveryModuleForbidsIt) {
    std::size_t decorated = 0;
    for (const ShaderModule& module : shaderModules()) {
        EXPECT_EQ(joined(contractible(module.words)), "") << module.name;
        for (const SpirvModule::Operation& operation : SpirvModule(module.words).operations())
            decorated += operation.no_contraction ? 1 : 0;
    }
    EXPECT_GT(decorated, 20'000u);
}

TEST(NoContraction, TheTablesHoldWhatModulesUse) {
    std::set<const ExactRow*> used;
    for (const ShaderModule& module : shaderModules())
        for (const SpirvModule::Operation& operation : SpirvModule(module.words).operations())
            used.insert(exactRowOf(operation));
    const auto check = [&](const auto& rows) {
        for (const ExactRow& row : rows) {
            EXPECT_TRUE(used.contains(&row)) << row.name << " is used by no module";
            EXPECT_FALSE(row.why.empty()) << row.name;
        }
    };
    check(exactInstructions);
    check(exactExtended);
}

// The module without the NoContraction decorations of these targets.
ModuleWords withoutDecorations(const ModuleWords& words, const std::set<std::uint32_t>& targets) {
    ModuleWords result(words.begin(), words.begin() + 5);
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16) {
        const bool removed = (words[i] & 0xffff) == opDecorate && words[i + 2] == noContractionDecoration &&
                             targets.contains(words[i + 1]);
        const auto at = words.begin() + static_cast<std::ptrdiff_t>(i);
        if (!removed) result.insert(result.end(), at, at + (words[i] >> 16));
    }
    return result;
}

// All functions are inlined in the embedded modules.
TEST(NoContraction, AModuleWithoutItIsFoundWithEachOfItsOperations) {
    std::size_t decorated = 0;
    for (const ShaderModule& module : shaderModules()) {
        const ModuleWords words = wordsOf(module);
        std::set<std::uint32_t> results;
        Faults expected;
        for (const SpirvModule::Operation& operation : SpirvModule(words).operations())
            if (operation.no_contraction) {
                results.insert(operation.result);
                expected.push_back(fmt::format("main: {} %{}", operationName(operation), operation.result));
            }
        decorated += results.size();
        EXPECT_EQ(contractible(withoutDecorations(words, results)), expected) << module.name;
    }
    EXPECT_GT(decorated, 5'000u);
}

// Replaces one instruction of the first kind by the second.
ModuleWords withInstructionReplaced(ModuleWords words, std::pair<std::uint32_t, std::uint32_t> op,
                                    std::pair<std::uint32_t, std::uint32_t> extended_op) {
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16) {
        if ((words[i] & 0xffff) != op.first || (op.first == opExtInst && words[i + 4] != extended_op.first))
            continue;
        words[i] = (words[i] & 0xffff0000) | op.second;
        if (op.first == opExtInst) words[i + 4] = extended_op.second;
        return words;
    }
    ADD_FAILURE() << "no such instruction";
    return words;
}

TEST(NoContraction, AnInstructionThatIsInNoTableIsFound) {
    // Replaces FMax by Fma, and an integer conversion by OpQuantizeToF16.
    const ModuleWords words = wordsOf(shaderModule(Shader::deferred_shade_frag));
    const Faults fma = contractible(withInstructionReplaced(words, {opExtInst, opExtInst}, {40, 50}));
    ASSERT_EQ(fma.size(), 1u);
    EXPECT_NE(fma[0].find(": instruction 50 of GLSL.std.450 %"), std::string::npos) << fma[0];
    const Faults quantised = contractible(withInstructionReplaced(words, {112, 116}, {}));
    ASSERT_EQ(quantised.size(), 1u);
    EXPECT_NE(quantised[0].find(": opcode 116 %"), std::string::npos) << quantised[0];
}

}  // namespace
}  // namespace diptych
