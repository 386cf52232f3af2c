// SPDX-License-Identifier: MIT
// diptych explain: causes with their contributions, as text, JSON and page.
#include "shared/image/exr.h"
#include "tests/tool/run.h"
#include "tests/tool/sweep.h"

#include <fmt/format.h>

#include <set>

namespace diptych {
namespace {

TEST(Command, ExplainNamesCausesAndTheirContributions) {
    const Folder folder;
    const Ran ran = runTool(folder, "explain builtin:points --gbuffer compact --size 64x36 --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json found = parsed(ran);
    double sum = found["unexplained"];
    for (const Json& cause : found["causes"]) {
        sum += cause["share"].get<double>();
        EXPECT_EQ(cause["where"].size(), 2u);
        EXPECT_EQ(cause["interval"], 0);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_GE(found["causes"].size(), 2u);
    const Ran words = runTool(folder, "explain builtin:points --size 64x36 --test haze=on");
    EXPECT_EQ(words.code, 0) << words.err;
    EXPECT_NE(words.out.find("--haze"), std::string::npos) << words.out;
    const Ran same = runTool(folder, "explain builtin:points --size 64x36 --gbuffer full");
    EXPECT_NE(same.out.find("no cause"), std::string::npos) << same.out;
}

TEST(Command, ExplainLeavesAPageWithItsMaps) {
    const Folder folder;
    const std::string view = "explain builtin:points --gbuffer compact --size 64x36";
    const Ran ran = runTool(folder, view + " -o why --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json found = parsed(ran);
    std::set<std::string> listed, there;
    for (const Json& name : found["files"]) listed.insert(name);
    for (const auto& entry : fs::directory_iterator(folder / "why")) there.insert(entry.path().filename());
    EXPECT_EQ(listed, there);
    for (const char* name :
         {"index.html", "explain.json", "dominant.png", "lit.baseline.png", "lit.test.png"})
        EXPECT_TRUE(there.contains(name)) << name;
    EXPECT_TRUE(there.contains("share-1." + found["causes"][0]["name"].get<std::string>() + ".png"));
    const std::string page = contentsOf(folder / "why/index.html");
    for (const std::string& name : there)
        EXPECT_TRUE(name.ends_with(".html") || page.find(name) != std::string::npos ||
                    (name == "unexplained.png" && found["unexplained"] == 0))
            << name;
    EXPECT_EQ(page.find("://"), std::string::npos) << "no external resources";
    // The command explains the same; its own output may be replaced.
    const std::string again = found["command"];
    ASSERT_TRUE(again.starts_with("diptych explain ")) << again;
    const Ran second = runTool(folder, again.substr(8) + " -o why");
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_NE(second.out.find("why/index.html"), std::string::npos) << second.out;
    EXPECT_EQ(readJson(folder / "why/explain.json")["causes"], found["causes"]);
    EXPECT_EQ(runTool(folder, view + " -o x.png").code, 2);
}

// From two files, which name their scene and Settings.
TEST(Command, ExplainReadsImages) {
    const Folder folder;
    const std::string view = " builtin:points --size 64x36 ";
    ASSERT_EQ(runTool(folder, "render" + view + "--path forward_plus -o a.exr").code, 0);
    ASSERT_EQ(runTool(folder, "render" + view + "--path deferred --gbuffer compact -o b.exr").code, 0);
    ASSERT_EQ(runTool(folder, "render" + view + "--channels lit,albedo -o few.exr").code, 0);
    const Ran ran = runTool(folder, "explain a.exr b.exr --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json of_files = parsed(ran);
    const Json drawn =
        parsed(runTool(folder, "explain" + view + "--baseline forward_plus --gbuffer compact --json"));
    EXPECT_EQ(of_files["causes"].dump(), drawn["causes"].dump());
    EXPECT_LT(of_files["unexplained"], 1e-6);
    EXPECT_EQ(of_files["reproduction"][0], 0);
    const std::string unused = "Settings come from the files; those of the command line are not used";
    EXPECT_EQ(ran.err.find(unused), ran.err.npos);
    const Ran with_settings = runTool(folder, "explain a.exr b.exr --haze on");
    EXPECT_NE(with_settings.err.find(unused), with_settings.err.npos) << with_settings.err;
    const Ran lacking = runTool(folder, "explain a.exr few.exr");
    EXPECT_EQ(lacking.code, 2);
    EXPECT_NE(lacking.err.find("few.exr has no channel"), std::string::npos) << lacking.err;
    EXPECT_EQ(runTool(folder, "explain a.exr").code, 2);
    ASSERT_EQ(runTool(folder, "render builtin:spots --size 64x36 -o other.exr").code, 0);
    const Ran other = runTool(folder, "explain a.exr other.exr");
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.err.find("--scene"), std::string::npos) << other.err;
    EXPECT_EQ(runTool(folder, "explain a.exr b.exr --test haze=on").code, 2);
}

// A file of another renderer with the terms of its lit: explain names the term that differs.
TEST(Command, ExplainNamesTheStageOfAnotherRenderer) {
    const Folder folder;
    const std::string scene = "builtin:points";
    ASSERT_EQ(runTool(folder, "render " + scene + " --size 64x36 --path forward_plus -o a.exr").code, 0);
    ImageFile theirs = readExr(folder / "a.exr");
    const auto layer = [&](std::string_view name) -> Image& {
        return std::ranges::find(theirs.layers, name, &ImageLayer::name)->image;
    };
    Image &lit = layer(""), &specular = layer("lit_specular");
    for (std::size_t p = 0; p < lit.pixels(); ++p)
        for (int c = 0; c < 3; ++c) {
            lit.pixel(p)[c] += 0.5f * specular.pixel(p)[c];
            specular.pixel(p)[c] *= 1.5f;
        }
    std::vector<ExrLayerView> views;
    for (const ImageLayer& one : theirs.layers) views.push_back({one.channels, &one.image});
    writeExr(folder / "b.exr", views);
    const Ran ran = runTool(folder, "explain a.exr b.exr -o why --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json found = parsed(ran);
    EXPECT_EQ(found["causes"][0]["name"], "direct specular") << ran.out;
    EXPECT_NEAR(found["causes"][0]["share"], 1, 1e-3);
    EXPECT_TRUE(fs::exists(folder / "why/share-1.direct-specular.png"));
}

TEST(Command, ExplainRefusesWhatItCannotSwap) {
    const Folder folder;
    for (const auto& [options, word] : {std::pair{"--test foo=1", "foo"},
                                        {"--test haze", "NAME=VALUE"},
                                        {"--test path=reference", "reference"},
                                        {"--test path=deferred", "same"},
                                        {"--test size=4x4", "size"},
                                        {"--baseline reference", "reference"},
                                        {"builtin:points builtin:spots", "spots"},
                                        {"--camera 0 --camera 0", "--camera"}}) {
        const Ran ran = runTool(folder, fmt::format("explain --size 16x16 {}", options));
        EXPECT_EQ(ran.code, 2) << options;
        EXPECT_NE(ran.err.find(word), std::string::npos) << ran.err;
    }
}

}  // namespace
}  // namespace diptych
