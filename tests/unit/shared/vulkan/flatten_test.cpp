// SPDX-License-Identifier: MIT
// Modules without the branches that a select replaces.
#include "shared/vulkan/spirv/flatten.h"

#include "shared/vulkan/spirv/spirv.h"
#include "tests/support/spirv_tools.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

namespace diptych {
namespace {

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
