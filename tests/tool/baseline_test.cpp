// SPDX-License-Identifier: MIT
// compare against an earlier image: messages, updating the baseline, errors.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Json = nlohmann::json;

const std::string comparePoints = "compare builtin:points --size 32x18 --runs 0 --channels lit,normals -q ";

Json reportIn(const Folder& folder) {
    return Json::parse(contentsOf(folder / "diptych-report" / "report.json"));
}

TEST(Baseline, IsWrittenComparedAndRenewed) {
    const Folder folder;
    Ran ran =
        runTool(folder, "compare builtin:points --size 32x18 --runs 0 --baseline b.exr --update-baseline");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("baseline b.exr written from forward_plus"), std::string::npos) << ran.err;
    const std::string first = contentsOf(folder / "b.exr");

    ran = runTool(folder, comparePoints + "--baseline b.exr");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    Json report = reportIn(folder);
    EXPECT_EQ(report["said_first"], Json::array()) << "same commit, device, driver, scene and Settings";
    ASSERT_EQ(report["comparisons"].size(), 3u);
    for (const Json& channel : report["comparisons"][1]["channels"])
        EXPECT_EQ(channel["max"], 0) << channel["name"];
    EXPECT_EQ(report["frames"][0]["name"], "baseline");
    EXPECT_NE(report["frames"][0]["origin"]["device"], "");
    EXPECT_NE(report["frames"][0]["origin"]["commit"], "");
    EXPECT_EQ(contentsOf(folder / "b.exr"), first) << "comparing writes no baseline";

    // Other lights change the Settings, which is stated before any number.
    ran = runTool(folder, "compare builtin:points --size 32x18 --runs 0 --baseline b.exr --lights point:2");
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.out.find("baseline: different Settings: lights \"\" (now \"point:2\")"), 0u) << ran.out;

    ran = runTool(folder, comparePoints + "--baseline b.exr --lights point:2 --update-baseline");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(contentsOf(folder / "b.exr.old"), first) << "the old one stays";
    EXPECT_NE(contentsOf(folder / "b.exr"), first);
    EXPECT_EQ(runTool(folder, comparePoints + "--baseline b.exr --lights point:2").code, 0);
}

// The G-buffer's encoding does not explain a moved light, whichever path the baseline has.
TEST(Baseline, AChangeOfTheLightFailsInEveryRow) {
    for (const std::string path : {"forward_plus", "deferred"}) {
        const Folder folder;
        ASSERT_EQ(
            runTool(folder, comparePoints + "--path " + path + " --baseline b.exr --update-baseline").code,
            0);
        ASSERT_EQ(runTool(folder, comparePoints + "--baseline b.exr").code, 0) << path;
        EXPECT_EQ(runTool(folder, comparePoints + "--baseline b.exr --lights point:2").code, 1);
        const Json report = reportIn(folder);
        for (const std::size_t row : {0u, 1u})
            EXPECT_EQ(report["comparisons"][row]["channels"][0]["verdict"], "fail") << path << " " << row;
        EXPECT_EQ(report["comparisons"][2]["verdict"], "pass") << "the two paths agree";
    }
}

TEST(Baseline, OfAnotherRendererNeedsARule) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render builtin:points --size 32x18 --runs 0 -q -o mine.exr").code, 0);
    const ImageFile mine = readExr(folder / "mine.exr");
    const auto lit = std::ranges::find(mine.layers, "", &ImageLayer::name);
    ASSERT_NE(lit, mine.layers.end());
    Image rgb(32, 18, 3);
    for (std::size_t i = 0; i < rgb.pixels(); ++i)
        for (std::size_t c = 0; c < 3; ++c) rgb.pixel(i)[c] = lit->image.pixel(i)[c] * 1.001f;
    writeExr(folder / "theirs.exr", {{{"R", "G", "B"}, &rgb}});
    Ran ran = runTool(folder, "compare builtin:points --size 32x18 --runs 0 --baseline theirs.exr");
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.out.find("baseline: not written by diptych"), 0u) << ran.out;
    EXPECT_NE(ran.out.find("no bound is known between these two paths"), std::string::npos) << ran.out;
    folder.write("t.json", R"({"rules": [{"channel": "lit", "flip": 0.05, "because": "another renderer"}]})");
    const std::string ruled =
        "compare builtin:points --size 32x18 --runs 0 --baseline theirs.exr --tolerances t.json";
    ran = runTool(folder, ruled);
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_EQ(runTool(folder, ruled + " --channels lit").code, 0);
    EXPECT_EQ(runTool(folder, ruled + " --channels lit,normals").code, 1) << "which theirs does not have";
}

TEST(Baseline, FaultsAreOneLine) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, comparePoints + "--baseline none.exr").failedOver("none.exr: no such file"));
    folder.write("text.exr", "no picture");
    EXPECT_TRUE(runTool(folder, comparePoints + "--baseline text.exr").failedOver("text.exr: "));
    ASSERT_EQ(runTool(folder, "render builtin:points --size 16x9 --runs 0 -q -o b.exr").code, 0);
    for (const char* whole : {"b.exr", "'b.exr?part=0'"})
        EXPECT_TRUE(runTool(folder, comparePoints + "--baseline " + whole).failedOver("16x9"));
    EXPECT_TRUE(runTool(folder, comparePoints + "--baseline 'b.exr?part=left'")
                    .failedOver("b.exr?part=left: has no part \"left\""));
    EXPECT_TRUE(runTool(folder, "compare builtin:points builtin:spheres --size 16x9 --baseline b.exr")
                    .failedOver("--baseline b.exr: a file holds one view"));
    const std::string before = contentsOf(folder / "b.exr");
    EXPECT_EQ(runTool(folder,
                      "compare builtin:points --size 16x9 --runs 0 -q --baseline b.exr --update-baseline "
                      "--path reference")
                  .code,
              2);
    EXPECT_EQ(contentsOf(folder / "b.exr"), before);
}

// Two runs of a path on a CPU device must be identical, otherwise there is a race: compare checks that.
TEST(Noise, EveryChannelIsDrawnTwice) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, comparePoints).code, 0);
    for (const Json& frame : reportIn(folder)["frames"]) {
        ASSERT_TRUE(frame["noise"].contains("lit"));
        EXPECT_TRUE(frame["noise"].contains("normals"));
    }
}

TEST(Selection, CompareKnowsMasksToo) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, comparePoints).code, 0);
    const int whole = reportIn(folder)["comparisons"][0]["covered_pixels"];
    ASSERT_EQ(runTool(folder, comparePoints + "--crop 12,9,8x8").code, 0);
    EXPECT_EQ(reportIn(folder)["comparisons"][0]["covered_pixels"], 64);
    EXPECT_TRUE(
        runTool(folder, comparePoints + "--crop 30,0,8x8").failedOver("--crop 30,0,8x8: is not inside"));
    ASSERT_EQ(runTool(folder, comparePoints + "--ignore-edges 1").code, 0);
    EXPECT_LT(reportIn(folder)["comparisons"][0]["covered_pixels"], whole);
}

}  // namespace
}  // namespace diptych
