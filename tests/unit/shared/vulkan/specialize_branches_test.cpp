// SPDX-License-Identifier: MIT
// Specialised modules of a few blocks, written here: which code stays, and in which order.
#include "shared/vulkan/spirv/shader_interface.h"
#include "tests/support/spirv_tools.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

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

// A loop that one branch leaves in its first iteration is plain code. A loop without iterations has no body.
TEST(Specialize, ALoopThatRunsOnceIsNone) {
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
    const std::string loops = specializedText(words, 3, 0), once = specializedText(words, 3, 1),
                      never = specializedText(words, 0, 0);
    EXPECT_EQ(countOf(loops, "OpFAdd"), 1u);
    EXPECT_EQ(countOf(loops, "OpLoopMerge"), 1u);
    EXPECT_EQ(countOf(once, "OpFAdd"), 1u);
    EXPECT_EQ(countOf(once, "OpIAdd"), 0u);
    EXPECT_EQ(countOf(once, "OpLoopMerge"), 0u);
    EXPECT_EQ(countOf(never, "OpFAdd"), 0u);
    EXPECT_EQ(countOf(never, "OpULessThan"), 0u);
}

// The test at a loop's end: what the first iteration knows counts only if there is no second.
TEST(Specialize, ALoopKnowsItsCounterWhileItRunsOnce) {
    const SpirvWords words = fragmentShader(R"(
OpBranch %loop
%loop = OpLabel
%i = OpPhi %uint %0u %entry %next %again
%sum = OpPhi %float %x %entry %more %again
OpLoopMerge %after %again None
OpBranch %body
%body = OpLabel
%first = OpIEqual %bool %i %0u
%term = OpSelect %float %first %one %y
%more = OpFAdd %float %sum %term
OpBranch %again
%again = OpLabel
%next = OpIAdd %uint %i %1u
%goes = OpULessThan %bool %next %number
OpBranchConditional %goes %loop %after
%after = OpLabel
OpStore %out %more
OpReturn
)");
    const std::string once = specializedText(words, 1, 0), twice = specializedText(words, 2, 0);
    EXPECT_EQ(countOf(once, "OpLoopMerge"), 0u);
    EXPECT_EQ(countOf(once, "OpIEqual"), 0u);
    EXPECT_EQ(countOf(once, "OpSelect "), 0u);
    EXPECT_EQ(countOf(once, "Input"), 2u);  // of x alone
    EXPECT_EQ(countOf(twice, "OpLoopMerge"), 1u);
    EXPECT_EQ(countOf(twice, "OpIEqual"), 1u);
}

// Two branches may leave a loop that does not go round: it stays one, with its continue target.
TEST(Specialize, ALoopThatDoesNotGoRoundMayStillBeOne) {
    const SpirvWords words = fragmentShader(R"(
OpBranch %loop
%loop = OpLabel
%sum = OpPhi %float %x %entry %more %again
OpLoopMerge %after %again None
OpBranch %test
%test = OpLabel
%goes = OpFOrdLessThan %bool %sum %one
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
OpBranch %loop
%after = OpLabel
%end = OpPhi %float %sum %test %more %leave
OpStore %out %end
OpReturn
)");
    const std::string once = specializedText(words, 0, 1);
    EXPECT_EQ(countOf(once, "OpLoopMerge"), 1u);
    EXPECT_EQ(countOf(once, "OpUndef"), 1u);
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

}  // namespace
}  // namespace diptych
