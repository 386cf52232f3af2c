// SPDX-License-Identifier: MIT
// A feature that is off costs nothing. The shipped module, specialised and without dead code, equals the
// module built from sources without the feature. The cut sources also lack its row in the list of
// features, so leftover uses would not compile.
#include "shared/contract/features.h"
#include "shared/vulkan/spirv/spirv.h"
#include "tests/support/campaign.h"
#include "tests/support/shader_sources.h"
#include "tests/support/spirv_module.h"
#include "tests/support/spirv_text.h"
#include "tests/support/spirv_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv-tools/optimizer.hpp>

#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// `old` occurs once in the file.
struct Cut {
    std::string_view file, old, put = "";
};

struct Without {
    std::string_view feature;
    gpu::uint id;
    std::vector<Cut> cuts;
    std::vector<std::string_view> modules;  // modules that read the feature
    // Further ones, which read it through the same includes: compared in a campaign, otherwise only
    // compiled, because the optimiser takes 2 to 5 s for each.
    std::vector<std::string_view> alike = {};
};

std::vector<Without> withouts() {
    return {
        {"haze",
         gpu::FEATURE_haze,
         {{"shaders/lib/shading/radiance.glsl",
           "    if (on(feature_haze)) sum = sum * radiance.transmittance + radiance.haze;\n"},
          {"shaders/lib/shading/shade.glsl", "#include \"shaders/lib/environment/haze.glsl\"\n"},
          {"shaders/lib/shading/shade.glsl",
           "    if (on(feature_haze)) {\n"
           "        Hazed hazed = hazeTo(s.position);\n"
           "        radiance.transmittance = hazed.transmittance;\n"
           "        radiance.haze = hazed.scattered;\n"
           "    }\n"},
          {"shaders/pass/background.frag", "environment/haze.glsl\"\n", "geometry/position.glsl\"\n"},
          {"shaders/pass/background.frag",
           "    if (on(feature_haze)) {\n"
           "        Hazed hazed = hazeBeyond(rayOrigin(gl_FragCoord.xy), away);\n"
           "        radiance = radiance * hazed.transmittance + hazed.scattered;\n"
           "    }\n"}},
         {"background.frag", "deferred_shade.frag", "forward_blended.frag"},
         {"deferred_capture.frag", "deferred_channel_terms.frag", "deferred_channels.frag",
          "deferred_further.frag", "deferred_shade.comp", "forward_blended_list.frag",
          "forward_blended_moments.frag", "forward_blended_weighted.frag", "forward_capture.frag",
          "forward_shade.frag"}},
        {"lights_in_front",
         gpu::FEATURE_lights_in_front,
         {{"shaders/pass/cull_lights_depth_bounds.comp",
           "    if (on(feature_lights_in_front)) far = min(far, z);\n"},
          {"shaders/pass/cull_lights_depth_bounds.comp",
           "        if (on(feature_lights_in_front)) farthest = floatBitsToUint(NO_DEPTH);\n"},
          {"shaders/pass/cull_lights_depth_bounds.comp",
           "    if (on(feature_lights_in_front)) {\n"
           "        far = subgroupMin(far);\n"
           "        if (subgroupElect()) atomicMin(farthest, floatBitsToUint(far));\n"
           "    }\n"},
          {"shaders/pass/cull_lights_depth_bounds.comp",
           "        if (on(feature_lights_in_front))\n"
           "            tile_depths[listInFront(tile)] = vec2(0.0, farthest > 0u ? largest : "
           "MAX_BOUND_RADIUS);\n"},
          {"shaders/pass/cull_lights_scatter.comp",
           "            if (on(feature_lights_in_front)) {\n"
           "                if (!overlapsInFront(bound, uvec2(column, row))) continue;\n"
           "                atomicOr(masks[maskWord(word, listInFront(list))], bit);\n"
           "            }\n"},
          {"shaders/pass/cull_lights_gather.comp",
           "            if (on(feature_lights_in_front)) {\n"
           "                within = within && overlapsInFront(bound, tile);\n"
           "                if (within) in_front |= bit;\n"
           "            }\n"},
          {"shaders/pass/cull_lights_gather.comp",
           "                if (on(feature_lights_in_front) && in_front != 0u)\n"
           "                    masks[maskWord(word, listInFront(tile_index))] = in_front;\n"}},
         {"cull_lights_depth_bounds.comp", "cull_lights_gather.comp", "cull_lights_scatter.comp"}},
    };
}

const ShaderModule& moduleNamed(std::string_view name) {
    for (const ShaderModule& module : shaderModules())
        if (module.name == name) return module;
    throw std::runtime_error(fmt::format("no module {}", name));
}

// Copies the sources to `root` and makes the cuts.
void copyWithout(const Without& without, const fs::path& root) {
    copyShaderSources(root);
    std::vector<Cut> cuts = without.cuts;
    const std::string list = contentsOf(root / "shared/contract/features.h");
    const std::size_t row = list.find(fmt::format("    X({},", without.id)), end = list.find('\n', row);
    ASSERT_NE(row, std::string::npos);
    std::string line = list.substr(row, end + 1 - row), kept;
    if (!line.ends_with("\\\n")) kept = "\n";  // the list's last row ends the macro
    cuts.push_back({"shared/contract/features.h", line, kept});
    for (const Cut& cut : cuts) replaceIn(root / cut.file, cut.old, cut.put);
}

using Values = std::map<std::uint32_t, std::uint32_t>;  // of specialization constants, otherwise 0

// Specialises as the program does, then tidies with SPIRV-Tools. Returns words that depend neither on ids
// nor on the order of declarations and blocks.
std::vector<std::string> specialised(std::span<const std::uint32_t> module, const Values& values,
                                     std::map<std::string, std::size_t>& known) {
    SpirvWords words = specialized(module, [&](std::uint32_t id) {
        const auto found = values.find(id);
        return found == values.end() ? 0 : found->second;
    });
    spvtools::Optimizer optimizer(spirvEnvironment);
    EXPECT_TRUE(optimizer.RegisterPassesFromFlags(
        {"--strip-debug", "--ccp", "--simplify-instructions", "--eliminate-dead-branches", "--merge-blocks",
         "--vector-dce", "--eliminate-dead-code-aggressive", "--eliminate-dead-variables",
         "--remove-unused-interface-variables", "--eliminate-dead-const", "--compact-ids"}));
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // it lacks scalar block layout
    EXPECT_TRUE(optimizer.Run(words.data(), words.size(), &words, options));
    return canonicalSpirv(disassembled(words), known);
}

// Two sets of other features: many switched on, and other values, which a campaign adds. Neither captures
// the haze's channels, which are constant without haze.
const Values otherFeatures[] = {{{0, 1},
                                 {3, 1},
                                 {9, 1},
                                 {12, 1},
                                 {14, 1},
                                 {15, 1},
                                 {16, 2},
                                 {20, 122880},
                                 {23, 1},
                                 {24, 3},
                                 {25, 1},
                                 {29, 3},
                                 {33, 1},
                                 {37, 1},
                                 {41, 1},
                                 {42, 7}},
                                {{14, 1}, {20, 122880}, {21, 1}, {25, 2}, {26, 2}, {42, 1}}};

class SpirvWithout : public testing::TestWithParam<std::size_t> {};

TEST_P(SpirvWithout, IsTheModuleOfSourcesWithoutIt) {
    Without without = withouts().at(GetParam());
    const fs::path root = folder(), file = root / "cut.spv";
    copyWithout(without, root);
    if (HasFatalFailure()) return;
    if (isCampaign()) std::ranges::move(without.alike, std::back_inserter(without.modules));
    for (const std::string_view name : without.alike)
        compileShader(root, fmt::format("shaders/pass/{}", name), file);
    for (const std::string_view name : without.modules) {
        compileShader(root, fmt::format("shaders/pass/{}", name), file);
        optimiseShader(file);
        if (HasFatalFailure()) return;
        const std::span<const std::uint32_t> with = moduleNamed(name).words;
        const std::string bytes = contentsOf(file);
        SpirvWords cut(bytes.size() / 4);
        std::memcpy(cut.data(), bytes.data(), bytes.size());
        for (const Values& others : std::span(otherFeatures).first(isCampaign() ? 2u : 1u)) {
            std::map<std::string, std::size_t> known;
            const std::vector<std::string> a = specialised(with, others, known),
                                           b = specialised(cut, others, known);
            ASSERT_GT(a.size(), 10u);
            const auto differ = std::ranges::mismatch(a, b);
            EXPECT_TRUE(a == b) << name << ": " << (differ.in1 == a.end() ? "nothing" : *differ.in1)
                                << " is not " << (differ.in2 == b.end() ? "nothing" : *differ.in2);
            // Negative control: the module with the feature differs.
            Values on = others;
            on[without.id] = 1;
            EXPECT_FALSE(specialised(with, on, known) == b) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Features, SpirvWithout, testing::Range<std::size_t>(0, withouts().size()),
                         [](const auto& each) { return std::string(withouts().at(each.param).feature); });

// The table names every entry point that draws scenes and whose modules use the feature.
TEST(SpirvWithoutFeatures, NoEntryPointIsForgotten) {
    for (const Without& without : withouts()) {
        std::vector<std::string_view> reading, held = without.modules;
        std::ranges::copy(without.alike, std::back_inserter(held));
        for (const ShaderModule& module : shaderModules())
            if (SpirvModule(module.words).usedConstants().contains(without.id))
                reading.push_back(module.name);
        std::ranges::sort(reading);
        std::ranges::sort(held);
        EXPECT_EQ(reading, held) << without.feature;
    }
}

// Negative control of the comparison: another value, decoration or instruction counts as a difference;
// other ids do not.
TEST(SpirvWithoutFeatures, WordsTellModulesApart) {
    const std::string module =
        "OpCapability Shader\nOpEntryPoint Vertex %3 \"main\" %9\nOpDecorate %9 Binding 2\n%1 = OpTypeVoid\n"
        "%2 = OpTypeFunction %1\n%4 = OpTypeFloat 32\n%5 = OpConstant %4 1\n%6 = OpConstant %4 2\n%7 = "
        "OpTypePointer Output %4\n%9 = OpVariable %7 Output\n%3 = OpFunction %1 None %2\n%8 = OpLabel\n%10 = "
        "OpFAdd %4 %5 %6\nOpStore %9 %10\nOpReturn\nOpFunctionEnd\n";
    const auto wordsWith = [&](const std::string& old, const std::string& put) {
        std::string text = module;
        for (std::size_t at = 0; !old.empty() && (at = text.find(old, at)) != std::string::npos;
             at += put.size())
            text.replace(at, old.size(), put);
        static std::map<std::string, std::size_t> known;
        return canonicalSpirv(text, known);
    };
    const auto own = wordsWith("", "");
    EXPECT_EQ(own, wordsWith("%10", "%77"));
    EXPECT_EQ(own, wordsWith("%5 = OpConstant %4 1\n%6 = OpConstant %4 2\n",
                             "%6 = OpConstant %4 2\n%5 = OpConstant %4 1\n"));
    EXPECT_NE(own, wordsWith("%4 %5 %6", "%4 %6 %5"));
    EXPECT_NE(own, wordsWith("%4 1\n", "%4 3\n"));
    EXPECT_NE(own, wordsWith("Binding 2", "Binding 3"));
    EXPECT_NE(own, wordsWith("OpFAdd", "OpFMul"));
    EXPECT_NE(own, wordsWith("%1 = OpTypeVoid", "OpDecorate %10 NoContraction\n%1 = OpTypeVoid"));

    const std::string branch = "OpSelectionMerge %22 None\nOpBranchConditional %11 %20 %21\n",
                      one = "%20 = OpLabel\nOpStore %9 %5\nOpBranch %22\n",
                      other = "%21 = OpLabel\nOpStore %9 %6\nOpBranch %22\n",
                      end = "%22 = OpLabel\nOpReturn\n";
    const auto branching = wordsWith("OpReturn\n", branch + one + other + end);
    EXPECT_EQ(branching, wordsWith("OpReturn\n", branch + other + one + end));
    EXPECT_NE(branching,
              wordsWith("OpReturn\n",
                        "OpSelectionMerge %22 None\nOpBranchConditional %11 %21 %20\n" + one + other + end));
    EXPECT_EQ(branching.size(), own.size() + 9) << "none is left out";
}

}  // namespace
}  // namespace diptych
