// SPDX-License-Identifier: MIT
// `plan` and `bench --compile-on`: a GPU's compiler without the GPU. Mesa's RADV compiles for the families it
// knows: Debian 12's (Mesa 22.3) lacks RDNA 3 and 4, Debian 13's has all.
#include "shared/vulkan/instance/driver_probe.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <set>

namespace diptych {
namespace {

const std::string smallSize = " --size 64x64 ";

class CompileOn : public testing::Test {
protected:
    void SetUp() override {
        if (radvFiles().empty()) GTEST_SKIP() << "RADV (mesa-vulkan-drivers) is not installed";
    }
    Folder folder;
};

TEST_F(CompileOn, EveryPipelineOfBothPathsIsCompiled) {
    const Ran ran = runTool(folder, "plan builtin:gallery --compile-on vega10 --json" + smallSize);
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "") << "the driver's remarks on missing hardware are none of the user's";
    const nlohmann::json scene = nlohmann::json::parse(ran.out)["scenes"][0];
    const nlohmann::json& compiled = scene["compiled"];
    EXPECT_NE(compiled["device"]["name"].get<std::string>().find("VEGA10"), std::string::npos);
    ASSERT_EQ(compiled["paths"].size(), 2u);
    const std::set<std::string> shades[] = {{"gbuffer.frag", "deferred_shade.frag", "deferred_capture.frag"},
                                            {"forward_shade.frag", "forward_capture.frag"}};
    for (std::size_t path = 0; path < 2; ++path) {
        std::set<std::string> names;
        for (const nlohmann::json& pipeline : compiled["paths"][path]["pipelines"]) {
            names.insert(pipeline["name"]);
            EXPECT_FALSE(pipeline.contains("error")) << pipeline;
            EXPECT_NE(pipeline["pass"], "") << pipeline["name"];
            ASSERT_FALSE(pipeline["shaders"].empty()) << pipeline["name"];
            for (const nlohmann::json& shader : pipeline["shaders"]) {
                EXPECT_GT(shader["cost"]["vgprs"], 0);
                EXPECT_GT(shader["cost"]["occupancy"], 0);
                EXPECT_EQ(shader["subgroup_size"], 64);
            }
        }
        for (const std::string& name : shades[path]) EXPECT_TRUE(names.contains(name)) << name;
        std::set<std::string> features;
        for (const nlohmann::json& cost : compiled["paths"][path]["features"])
            features.insert(cost["feature"]);
        for (const char* feature : {"shadows", "normal_texture", "point_lights"})
            EXPECT_TRUE(features.contains(feature)) << feature << " adds nothing";
        EXPECT_FALSE(features.contains("area_lights")) << "the gallery has none";
    }
}

TEST_F(CompileOn, AnEstimateIsOfTheFamilysGpu) {
    const Ran ran =
        runTool(folder, "plan builtin:triangle --compile-on vega10 --json --estimate" + smallSize);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const nlohmann::json work = nlohmann::json::parse(ran.out)["scenes"][0]["work"];
    ASSERT_EQ(work.size(), 2u);
    ASSERT_EQ(work[0]["estimates"].size(), 1u);
    EXPECT_EQ(work[0]["estimates"][0]["gpu"], "AMD Radeon RX Vega 64");
}

TEST_F(CompileOn, ATableAndWhatFeaturesAddAreText) {
    const Ran ran = runTool(folder, "plan builtin:areas --compile-on vega10" + smallSize);
    ASSERT_EQ(ran.code, 0) << ran.err;
    for (const char* word :
         {"VGPRs", "occupancy", "forward_shade.frag", "deferred_shade.frag", "area_lights "})
        EXPECT_NE(ran.out.find(word), std::string::npos) << word << "\n" << ran.out;
}

TEST_F(CompileOn, BenchCountsTheRegistersOfPassesThatShade) {
    const Ran ran =
        runTool(folder,
                "bench --table layers --compile-on vega10 --paths deferred --light-counts 1 --size "
                "32x18 --runs 1 --shadows off --max-ms 1e6 --json -q -o b");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const nlohmann::json layers = nlohmann::json::parse(ran.out)["layers"];
    EXPECT_NE(layers["compiler"].get<std::string>().find("VEGA10"), std::string::npos);
    for (const nlohmann::json& row : layers["rows"]) {
        const std::string kind = row["covered"];
        ASSERT_EQ(row["ways"].size(), 2u) << row;
        for (const nlohmann::json& way : row["ways"]) {
            std::set<std::string> passes;
            for (const nlohmann::json& pass : way["registers"]) {
                passes.insert(pass["pass"]);
                EXPECT_GT(pass["least"], 0);
                EXPECT_LE(pass["least"], pass["most"]);
            }
            const bool apart = way["name"] == "deferred by forward" && kind != "" && kind != "glass";
            EXPECT_EQ(passes.contains("shade layers"), apart) << row;
            EXPECT_EQ(passes.contains("transmission"), kind == "glass") << row;
            EXPECT_EQ(passes.contains("shade"), !apart || row["percent"] != 100) << row;
        }
    }
}

TEST_F(CompileOn, WhatCannotCompileIsOneLine) {
    const Ran unknown = runTool(folder, "plan builtin:gallery --compile-on navi999" + smallSize);
    EXPECT_TRUE(unknown.failedOver("--compile-on navi999: no such device"));
    EXPECT_TRUE(unknown.failedOver("Mesa 25"));
    const Ran silent = runTool(folder, "plan builtin:gallery --compile-on llvmpipe" + smallSize);
    EXPECT_TRUE(silent.failedOver("does not report compiler statistics"));
}

// RADV's null device executes nothing, and is never selected for rendering.
TEST_F(CompileOn, HardwareThatIsNotThereDrawsNothing) {
    const std::string forced = "RADV_FORCE_FAMILY=vega10 '" DIPTYCH_PROGRAM "' ";
    const Ran listed =
        runShell(folder, forced + "plan builtin:triangle -q --device VEGA10" + smallSize, folder.path());
    EXPECT_EQ(listed.code, 2);
    EXPECT_NE(listed.err.find("lacks memory"), std::string::npos) << listed.err;
    const Ran compiles =
        runShell(folder, forced + "plan builtin:triangle --compile-on VEGA10" + smallSize, folder.path());
    EXPECT_EQ(compiles.code, 0) << compiles.err;
}

}  // namespace
}  // namespace diptych
