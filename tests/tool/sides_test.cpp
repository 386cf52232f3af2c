// SPDX-License-Identifier: MIT
// Paths with different Settings, as users see them.
#include "tests/tool/sweep.h"

namespace diptych {
namespace {

const std::string sidesView = " builtin:spots --size 48x27 ";

TEST(SideSettings, LightsByObjectAgainstFroxels) {
    const Folder folder;
    const Ran refused = runTool(folder, "compare --assign per_object" + sidesView);
    EXPECT_TRUE(refused.failedOver("--forward-plus assign=per_object"));
    const Ran ran = runTool(
        folder, "compare --forward-plus assign=per_object,pixel-lights=2 --runs 0" + sidesView + "-o r");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("--assign clustered and per_object, --pixel-lights 4 and 2"), std::string::npos);
    const Json report = readJson(folder / "r/report.json");
    EXPECT_EQ(report["frames"][0]["settings"]["assign"], "clustered");
    EXPECT_EQ(report["frames"][1]["settings"]["assign"], "per_object");
    const auto litOf = [](const Json& comparison) {
        for (const Json& channel : comparison["channels"])
            if (channel["name"] == "lit") return channel;
        return Json();
    };
    const Json lit = litOf(report["comparisons"][0]);
    EXPECT_EQ(lit["verdict"], "informative");
    EXPECT_GT(lit["max"], 0.1);
    // The printed command renders the same.
    std::string again = "compare --runs 0 --force";
    for (std::size_t i = 1; i < report["comparisons"][0]["command"].size(); ++i)
        again += " '" + std::string(report["comparisons"][0]["command"][i]) + "'";
    EXPECT_EQ(runTool(folder, again).code, 0);
    EXPECT_EQ(litOf(readJson(folder / "r/report.json")["comparisons"][0])["max"], lit["max"]);
    // With rules it is judged after all.
    folder.write("t.json", R"({ "rules": [ { "channel": "lit", "max": 0.01, "because": "close" } ] })");
    EXPECT_EQ(runTool(folder,
                      "compare --forward-plus assign=per_object,pixel-lights=2 --runs 0 --tolerances t.json" +
                          sidesView + "-o s")
                  .code,
              1);
    // explain and the pixel breakdown accept the same options.
    const Ran why =
        runTool(folder, "explain --forward-plus assign=per_object,pixel-lights=2 --json" + sidesView);
    ASSERT_EQ(why.code, 0) << why.err;
    EXPECT_EQ(Json::parse(why.out)["causes"][0]["name"], "lights per object") << why.out;
    const Ran breakdown = runTool(
        folder, "compare --forward-plus assign=per_object,pixel-lights=2 --pixel 24,20 --json" + sidesView);
    EXPECT_EQ(breakdown.code, 0) << breakdown.err;
}

// Settings that do not change the light are judged as usual.
TEST(SideSettings, OtherListsOfTheSameLightsAreNoDifference) {
    const Folder folder;
    const Ran ran =
        runTool(folder, "compare --deferred assign=tiled,gbuffer=full --forward-plus assign=every --runs 0" +
                            sidesView + "-o r");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    for (const Json& channel : readJson(folder / "r/report.json")["comparisons"][0]["channels"])
        if (channel["name"] == "lit") {
            EXPECT_EQ(channel["verdict"], "pass");
            EXPECT_EQ(channel["max"], 0);
        }
    EXPECT_TRUE(runTool(folder, "explain --test gbuffer=full --deferred assign=tiled" + sidesView)
                    .failedOver("--test"));
}

}  // namespace
}  // namespace diptych
