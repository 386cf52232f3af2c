// SPDX-License-Identifier: MIT
// Comparisons with a stored reference, and a reference that needs no device.
#include "shared/image/exr.h"
#include "tests/tool/sweep.h"

#include <algorithm>

namespace diptych {
namespace {

// A stored reference gives the same verdicts as a freshly rendered one.
TEST(ReferenceTool, AStoredReferenceEvaluatesAsOneDrawnNow) {
    const Folder folder;
    const std::string drawing = "compare builtin:triangle --size 16x9 --runs 0 ";
    const Ran now = runTool(folder, drawing + "--baseline reference -o now");
    ASSERT_LE(now.code, 1) << now.err;
    const Ran stored = runTool(folder, drawing + "--baseline now/reference.exr -o stored");
    EXPECT_EQ(stored.code, now.code) << stored.err;
    Json a = readJson(folder / "now/report.json"), b = readJson(folder / "stored/report.json");
    // The file has no light of decoded surfaces: forward+ shows instead what the encoding changes.
    for (Json* const json : {&a, &b})
        for (Json& channel : (*json)["comparisons"][0]["channels"])
            if (channel["name"].get<std::string>().starts_with("lit")) {
                for (const char* key : {"because", "worst_pixel", "worst_values"}) channel.erase(key);
                channel["criterion"].erase("measured");
            }
    for (const std::size_t row : {0u, 1u})
        EXPECT_EQ(a["comparisons"][row]["channels"], b["comparisons"][row]["channels"]);
}

// A sampled reference is evaluated with each pixel's uncertainty, which is not a channel of the image.
TEST(ReferenceTool, AStoredReferenceKeepsItsUncertainty) {
    const Folder folder;
    Image sky(8, 4, 3, 0.2f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    ASSERT_EQ(
        runTool(folder, "render --path reference builtin:triangle --size 16x9 --env sky.exr -o r.exr").code,
        0);
    const Ran compared =
        runTool(folder, "compare builtin:triangle --size 16x9 --runs 0 --baseline r.exr -o out");
    EXPECT_LE(compared.code, 1) << compared.err;
    const Json report = readJson(folder / "out/report.json");
    EXPECT_GT(report["frames"][0]["uncertainty"].get<double>(), 0);
    for (const std::size_t row : {0u, 1u})
        EXPECT_NE(report["comparisons"][row]["channels"].dump().find("the reference's uncertainty"),
                  std::string::npos);
    const ImageFile exr = readExr(folder / "r.exr");
    EXPECT_EQ(std::ranges::count(exr.layers, "uncertainty", &ImageLayer::name), 1);
    const Ran diff = runTool(folder, "diff r.exr r.exr --json");
    EXPECT_EQ(diff.code, 0) << diff.err;
    EXPECT_NE(diff.out.find("albedo"), std::string::npos) << diff.out;
    EXPECT_EQ(diff.out.find("uncertainty"), std::string::npos) << diff.out;
}

// Light is compared as strictly with few channels, as in a report's command for one channel: FLIP alone
// would pass this ambient light.
TEST(ReferenceTool, FewerChannelsAreNotEvaluatedMoreLoosely) {
    const Folder folder;
    const std::string scene = "builtin:spheres --size 64x36 --runs 0 --shadows off ";
    ASSERT_EQ(runTool(folder, "render " + scene +
                                  "--path reference --reference-mode scene --ambient 0.5,0.5,0.5 -q -o r.exr")
                  .code,
              0);
    const Ran ran =
        runTool(folder, "compare " + scene + "--baseline r.exr --channels lit,lit_diffuse -q -o report");
    EXPECT_EQ(ran.code, 1) << ran.err;
    const Json report = readJson(folder / "report/report.json");
    for (const std::size_t pair : {0u, 1u}) {
        const Json& channels = report["comparisons"][pair]["channels"];
        ASSERT_EQ(channels.size(), 2u) << "what light is judged by is not compared";
        EXPECT_EQ(channels[0]["verdict"], "fail");
        EXPECT_GT(channels[0]["footprints"]["smooth"].get<int>(), 0);
    }
}

// Mode scene needs no Vulkan at all.
TEST(ReferenceTool, ModeSceneIsDrawnWithoutADevice) {
    const Folder folder;
    const std::string words =
        " render --path reference --reference-mode scene builtin:spots --size 16x9 --runs 0 -o ";
    const auto run = [&](const char* environment, const std::string& file) {
        return runShell(folder, environment + (" '" DIPTYCH_PROGRAM "'" + words) + file, folder.path());
    };
    const Ran without = run("VK_DRIVER_FILES=/no/such/driver.json", "without.exr");
    EXPECT_EQ(without.code, 0) << without.err;
    EXPECT_EQ(run("", "with.exr").code, 0);
    EXPECT_EQ(runTool(folder, "diff with.exr without.exr -q --metric max").code, 0);
    EXPECT_EQ(readExr(folder / "without.exr").attributes.at("device"), "double precision, no Vulkan device");
    const Ran surface = runShell(folder,
                                 "VK_DRIVER_FILES=/no/such/driver.json '" DIPTYCH_PROGRAM
                                 "' render --path reference builtin:spots -o x.exr",
                                 folder.path());
    EXPECT_EQ(surface.code, 2);
    EXPECT_NE(surface.err.find("VK_DRIVER_FILES names /no/such/driver.json, which does not exist"),
              std::string::npos)
        << surface.err;
}

}  // namespace
}  // namespace diptych
