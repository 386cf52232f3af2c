// SPDX-License-Identifier: MIT
// The plan of compiled shaders, from made-up compiler statistics.
#include "compare/render/compiled_plan.h"
#include "compare/bench/compiled_text.h"
#include "compare/bench/estimate.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

ShaderCost cost(double vgprs, double occupancy, double cycles) {
    ShaderCost said;
    said.vector_registers = vgprs;
    said.occupancy = occupancy;
    said.cycles = cycles;
    return said;
}

PlannedPipeline pipeline(const std::string& pass, const std::string& name, const ShaderCost& said,
                         const std::string& variant = "") {
    return {pass, false, name, variant, {{{name, 64, {{"VGPRs", *said.vector_registers}}, said}}, ""}, {}};
}

const DeviceInfo someGpu{0, "a GPU", "a driver 1.0", "discrete", "1.3.0", {}};

TEST(CompiledPlan, StatisticsAreFoundByTheDriversNames) {
    const std::vector<CompilerStatistic> said{{"VGPRs", 96}, {"Subgroups per SIMD", 10}, {"Colour", 3}};
    const ShaderCost found = costOf(said);
    EXPECT_EQ(found.vector_registers, 96);
    EXPECT_EQ(found.occupancy, 10);
    EXPECT_EQ(found.cycles, std::nullopt) << "not said";
}

TEST(CompiledPlan, FewerWavesAreHeavierThanMoreRegisters) {
    EXPECT_TRUE(isHeavier(cost(64, 8, 1), cost(96, 16, 9)));
    EXPECT_FALSE(isHeavier(cost(96, 16, 9), cost(64, 8, 1)));
    EXPECT_TRUE(isHeavier(cost(96, 8, 1), cost(64, 8, 9)));
    EXPECT_TRUE(isHeavier(cost(64, 8, 2), cost(64, 8, 1)));
    EXPECT_FALSE(isHeavier(cost(64, 8, 1), cost(64, 8, 1)));
}

TEST(CompiledPlan, AVariantIsTheFeaturesThatAreOn) {
    Variant variant;
    EXPECT_EQ(describe(variant), "");
    variant.set(gpu::FEATURE_point_lights).set(gpu::FEATURE_shadows, 2);
    EXPECT_EQ(describe(variant), "point_lights shadows=2");
}

// A switch is a feature that a view may lack: not a feature's parameter, and not the G-buffer's encoding.
TEST(CompiledPlan, SwitchesAreWhatAViewMayLack) {
    std::vector<std::string> switches;
    for (const FeatureRow& row : featureRows)
        if (row.switches) switches.emplace_back(row.name);
    const auto has = [&](const char* name) { return std::ranges::count(switches, name) == 1; };
    for (const char* name : {"normal_texture", "shadows", "area_lights", "environment", "samples"})
        EXPECT_TRUE(has(name)) << name;
    for (const char* name : {"shadow_kernel", "list_width", "gbuffer_encoding", "captured", "view_source"})
        EXPECT_FALSE(has(name)) << name;
}

TEST(CompiledPlan, SpillsAreWarningsAndWhatDoesNotCompileAnError) {
    CompiledPath path{Path::forward_plus, {}, {}, {}, {}};
    path.pipelines.push_back(pipeline("shade", "light.frag", cost(32, 16, 1)));
    path.pipelines.push_back(pipeline("shade", "heavy.frag", cost(256, 4, 1), "shadows=1"));
    path.pipelines.back().compiled.shaders[0].cost.spilled_vectors = 12;
    path.pipelines.push_back({"shade", false, "broken.frag", "", {{}, "does not compile: no"}, {}});
    evaluate(path);
    ASSERT_EQ(path.warnings.size(), 1u);
    EXPECT_EQ(path.warnings[0],
              "forward_plus, shade: heavy.frag spills 12 vector and 0 scalar registers, 0 bytes of scratch "
              "(shadows=1)");
    ASSERT_EQ(path.errors.size(), 1u);
    EXPECT_EQ(path.errors[0], "forward_plus, shade: broken.frag does not compile: no");
}

TEST(CompiledPlan, AFeatureIsWhatItAdds) {
    EXPECT_EQ(bench::addedText({"area_lights", "shade", "x.frag", cost(102, 10, 700), cost(64, 16, 500)}),
              "+38 VGPRs, occupancy 16 -> 10, +200 cycles");
    EXPECT_EQ(bench::addedText({"area_lights", "shade", "x.frag", cost(64, 16, 500), cost(72, 16, 500)}),
              "-8 VGPRs");
}

// A shader of both paths has one row, with its most expensive variant.
TEST(CompiledPlan, PathsStandSideBySide) {
    const std::vector<CompiledPath> paths{{Path::deferred,
                                           {pipeline("depth", "depth.vert", cost(24, 16, 10)),
                                            pipeline("shade", "deferred.frag", cost(80, 12, 900))},
                                           {},
                                           {},
                                           {}},
                                          {Path::forward_plus,
                                           {pipeline("depth", "depth.vert", cost(24, 16, 10)),
                                            pipeline("shade", "forward.frag", cost(64, 16, 700)),
                                            pipeline("shade", "forward.frag", cost(120, 8, 1200))},
                                           {},
                                           {},
                                           {"a line"}}};
    const std::string text = bench::compiledText(paths, someGpu);
    const auto lineOf = [&](const std::string& word) {
        const std::size_t at = text.find(word), begin = text.rfind('\n', at) + 1;
        return text.substr(begin, text.find('\n', at) - begin);
    };
    const auto numbers = [&](const std::string& word) {
        std::vector<std::string> found;
        std::istringstream words(lineOf(word));
        for (std::string one; words >> one;) found.push_back(one);
        return found;
    };
    using Words = std::vector<std::string>;
    EXPECT_EQ(numbers("depth.vert"), (Words{"depth", "depth.vert", "|", "1", "24", "-", "-", "16", "-", "10",
                                            "|", "1", "24", "-", "-", "16", "-", "10"}));
    EXPECT_EQ(numbers("forward.frag"),
              (Words{"shade", "forward.frag", "|", "|", "2", "120", "-", "-", "8", "-", "1200"}));
    EXPECT_EQ(numbers("deferred.frag"),
              (Words{"shade", "deferred.frag", "|", "1", "80", "-", "-", "12", "-", "900", "|"}));
    EXPECT_NE(text.find("  warning: a line\n"), std::string::npos);
    const auto json = bench::compiledJson(paths, someGpu);
    EXPECT_EQ(json["paths"][1]["pipelines"][2]["shaders"][0]["cost"]["vgprs"], 120);
    EXPECT_EQ(json["paths"][1]["pipelines"][2]["shaders"][0]["statistics"]["VGPRs"], 120);
    EXPECT_FALSE(json["paths"][1]["pipelines"][2]["shaders"][0]["cost"].contains("sgprs"));
}

TEST(CompiledPlan, CyclesOfAPassAreMeansOfItsPipelines) {
    CompiledPath path{Path::forward_plus, {}, {}, {}, {}};
    const ShaderCost vertex = cost(24, 16, 30);
    for (const double cycles : {900.0, 1300.0}) {
        PlannedPipeline shading = pipeline("shade", "forward.frag", cost(64, 16, cycles));
        shading.compiled.shaders.insert(shading.compiled.shaders.begin(), {"surface.vert", 64, {}, vertex});
        shading.unlit_cycles = 500;
        path.pipelines.push_back(shading);
    }
    path.pipelines.push_back(pipeline("lists", "lists.comp", cost(24, 16, 70)));
    path.pipelines.push_back(pipeline("shade", "capture.frag", cost(24, 16, 1e6)));
    path.pipelines.back().captures = true;
    const std::vector<bench::PassCycles> cycles = bench::passCycles(path);
    ASSERT_EQ(cycles.size(), 2u);
    EXPECT_EQ(cycles[0].pass, "shade");
    EXPECT_DOUBLE_EQ(cycles[0].vertex, 30);
    EXPECT_DOUBLE_EQ(cycles[0].fragment, 500);
    EXPECT_DOUBLE_EQ(cycles[0].light, (400.0 + 800.0) / 8 / 2) << "eight turns of the loop over lights";
    EXPECT_DOUBLE_EQ(cycles[1].compute, 70);
}

}  // namespace
}  // namespace diptych
