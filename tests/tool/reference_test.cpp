// SPDX-License-Identifier: MIT
// The reference as the tool draws it: alone, against both paths, interrupted and gone on with.
#include "tests/tool/faults.h"
#include "tests/tool/running.h"

#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Json = nlohmann::json;

Json jsonIn(const fs::path& file) {
    return Json::parse(contentsOf(file), nullptr, false);
}

// ---- one frame ---------------------------------------------------------------------------------------

TEST(ReferenceTool, RendersInBothModes) {
    const Folder folder;
    for (const std::string mode : {"surface", "scene"}) {
        const Ran ran =
            runTool(folder, "render builtin:triangle --size 32x18 --path reference --reference-mode " + mode +
                                " -o " + mode);
        EXPECT_EQ(ran.code, 0) << ran.err;
        const Json frame = jsonIn(folder / mode / "frame.json");
        EXPECT_NE(frame.dump().find("\"reference\""), std::string::npos) << frame.dump();
        EXPECT_TRUE(fs::exists(folder / mode / "reference.exr")) << ran.out;
    }
    // One triangle without a texture: the same place, but for what a raster snaps.
    const Ran same = runTool(folder,
                             "diff surface/reference.exr scene/reference.exr --channels lit "
                             "--metric relative_p99 --tolerance 1e-4");
    EXPECT_EQ(same.code, 0) << same.out << same.err;
}

TEST(ReferenceTool, WhatAPathIsToldChangesNothing) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render builtin:triangle --size 32x18 --path reference -o a.exr").code, 0);
    for (const std::string option : {"--gbuffer compact", "--gbuffer full", "--prepass on"}) {
        const Ran ran = runTool(
            folder, "render builtin:triangle --size 32x18 --path reference --force -o b.exr " + option);
        EXPECT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(runTool(folder, "diff a.exr b.exr --metric max --tolerance 0").code, 0) << option;
    }
}

TEST(ReferenceTool, RefusesWhatHasNoMeaning) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, "render builtin:triangle --path reference --spp 4").failedOver("--spp 4"));
    EXPECT_TRUE(runTool(folder, "plan builtin:triangle --path reference").failedOver("--path reference"));
    EXPECT_TRUE(runTool(folder, "compare builtin:triangle --baseline reference --update-baseline")
                    .failedOver("--update-baseline"));
    EXPECT_TRUE(runTool(folder, "render builtin:triangle --path reference --reference-mode other")
                    .failedOver("other"));
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
}

// ---- against both paths ------------------------------------------------------------------------------

TEST(ReferenceTool, IsTheLeftPanelOfBothPaths) {
    const Folder folder;
    const Ran ran = runTool(folder,
                            "compare builtin:triangle --size 32x18 --runs 0 --ambient 0.1,0.1,0.1 --baseline "
                            "reference --json -o r "
                            "--camera 'eye=0,0,3 target=0,0,0' --camera 'eye=1,0,3 target=0,0,0'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = jsonIn(folder / "r/report.json");
    EXPECT_EQ(Json::parse(ran.out, nullptr, false)["truth"], report["truth"])
        << "what --json prints is the file";
    EXPECT_EQ(report["verdict"], "pass");
    ASSERT_EQ(report["frames"].size(), 6u);
    ASSERT_EQ(report["comparisons"].size(), 6u) << "both paths against the reference, and against each other";
    ASSERT_EQ(report["truth"].size(), 2u) << "one a camera";
    for (const Json& truth : report["truth"]) {
        ASSERT_EQ(truth["channels"].size(), 4u) << "lit, its two lobes and ambient light";
        for (const Json& channel : truth["channels"]) {
            EXPECT_EQ(channel["nearer"], "forward_plus") << "a packed G-buffer is further away";
            EXPECT_GT(channel["by"].get<double>(), 1);
            EXPECT_GT(channel["error"]["deferred"]["mean"].get<double>(),
                      channel["error"]["forward_plus"]["mean"].get<double>());
        }
    }
    EXPECT_NE(contentsOf(folder / "r/index.html").find("id=\"truth\""), std::string::npos);
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename().string().find(".reference-"), std::string::npos) << entry.path();
}

TEST(ReferenceTool, FitsIntoOneFile) {
    const Folder folder;
    const Ran ran = runTool(
        folder, "compare builtin:triangle --size 32x18 --runs 0 --baseline reference --single-file -o r");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string page = contentsOf(folder / "r/index.html");
    EXPECT_NE(page.find("id=\"truth\""), std::string::npos);
    EXPECT_EQ(page.find(".nearer.png\""), std::string::npos) << "its pictures are in it";
}

// Exit code 1: a tolerance that no float32 keeps.
TEST(ReferenceTool, ADifferenceIsExitCodeOne) {
    const Folder folder;
    folder.write("none.json", R"({"rules": [{"channel": "lit", "max": 0, "because": "to fail"}]})");
    const Ran ran = runTool(folder,
                            "compare builtin:triangle --size 32x18 --runs 0 --baseline reference "
                            "--tolerances none.json -o r");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_EQ(jsonIn(folder / "r/report.json")["verdict"], "fail");
}

// ---- interrupted -------------------------------------------------------------------------------------

constexpr const char* panel =
    R"({"lights": [{"type": "rect", "position": [0, 3, 1], "direction": [0, -1, 0], "size": [2, 1], "intensity": 100}]})";
const std::vector<std::string> longDrawing{
    "render", "builtin:gallery", "--path", "reference", "--reference-mode", "scene", "--spp", "2", "--size",
    "64x36",  "--shadows",       "pcf",    "--lights",  "panel.json",       "-o",    "r.exr"};

std::string inShell(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += word + " ";
    return line;
}

void endsAndGoesOn(int signal, bool says) {
    const Folder folder;
    folder.write("panel.json", panel);
    const fs::path kept = folder / ".r.exr.reference-1";
    Running tool(folder, longDrawing);
    // A head, and a tile at least.
    const auto size = [&] {
        std::error_code none;
        const std::uintmax_t bytes = fs::file_size(kept, none);
        return none ? 0 : bytes;
    };
    ASSERT_TRUE(soon([&] { return size() > 20000 || tool.ended(); })) << tool.err();
    ASSERT_FALSE(tool.ended()) << "too quick to be interrupted";
    ::kill(tool.process(), signal);
    ASSERT_TRUE(soon([&] { return tool.ended(); }));
    EXPECT_TRUE(WIFSIGNALED(tool.wait()) && WTERMSIG(tool.wait()) == signal) << tool.wait();
    EXPECT_EQ(tool.err().find(".r.exr.reference-1: the same command goes on") != std::string::npos, says)
        << tool.err();
    ASSERT_GT(size(), 20000u) << "what is done is there";
    EXPECT_FALSE(fs::exists(folder / "r.exr"));

    const Ran again = runTool(folder, inShell(longDrawing));
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_FALSE(fs::exists(kept)) << "the picture is whole";

    static std::string whole;  // drawn once for every signal
    if (whole.empty()) {
        fs::rename(folder / "r.exr", folder / "first.exr");
        ASSERT_EQ(runTool(folder, inShell(longDrawing)).code, 0);
        whole = contentsOf(folder / "r.exr");
        fs::rename(folder / "first.exr", folder / "r.exr");
    }
    folder.write("whole.exr", whole);
    const Ran same = runTool(folder, "diff whole.exr r.exr --metric max --tolerance 0 --json");
    EXPECT_EQ(same.code, 0) << same.out << same.err;
}

TEST(ReferenceTool, InterruptedItSaysWhereItsWorkIsAndGoesOn) {
    endsAndGoesOn(SIGINT, true);
}

TEST(ReferenceTool, KilledItGoesOnAsWell) {
    endsAndGoesOn(SIGKILL, false);
}

// Of another picture: begun anew, not mixed into it.
TEST(ReferenceTool, WhatIsKeptOfAnotherPictureIsNotGoneOnFrom) {
    const Folder folder;
    const std::string command = "render builtin:triangle --path reference --size 32x18 --force -o r.exr";
    ASSERT_EQ(runTool(folder, command).code, 0);
    fs::rename(folder / "r.exr", folder / "sound.exr");
    folder.write(".r.exr.reference-1", std::string(5000, 'x'));
    const Ran ran = runTool(folder, command);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(runTool(folder, "diff sound.exr r.exr --metric max --tolerance 0").code, 0);
    EXPECT_FALSE(fs::exists(folder / ".r.exr.reference-1"));
}

}  // namespace
}  // namespace diptych
