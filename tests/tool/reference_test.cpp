// SPDX-License-Identifier: MIT
// The reference through the tool: alone, compared with both paths, interrupted and resumed.
#include "shared/image/exr.h"
#include "tests/tool/faults.h"
#include "tests/tool/running.h"
#include "tests/tool/sweep.h"

#include <cstring>
#include <regex>
#include <set>

namespace diptych {
namespace {

// ---- one frame ---------------------------------------------------------------------------------------

TEST(ReferenceTool, RendersInBothModes) {
    const Folder folder;
    for (const std::string mode : {"surface", "scene"}) {
        const Ran ran =
            runTool(folder, "render builtin:triangle --size 32x18 --path reference --reference-mode " + mode +
                                " -o " + mode);
        EXPECT_EQ(ran.code, 0) << ran.err;
        const Json frame = readJson(folder / mode / "frame.json");
        EXPECT_NE(frame.dump().find("\"reference\""), std::string::npos) << frame.dump();
        EXPECT_TRUE(fs::exists(folder / mode / "reference.exr")) << ran.out;
    }
    // An untextured triangle shows the same surface point in both modes, up to the rasteriser's snapping.
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
    const Json report = readJson(folder / "r/report.json");
    EXPECT_EQ(Json::parse(ran.out, nullptr, false)["truth"], report["truth"])
        << "what --json prints is the file";
    EXPECT_EQ(report["verdict"], "pass");
    ASSERT_EQ(report["frames"].size(), 6u);
    ASSERT_EQ(report["comparisons"].size(), 6u) << "both paths against the reference, and against each other";
    ASSERT_EQ(report["truth"].size(), 2u) << "one a camera";
    for (const Json& truth : report["truth"]) {
        ASSERT_EQ(truth["channels"].size(), 5u) << "lit, its two lobes, ambient light and an environment's";
        for (const Json& channel : truth["channels"]) {
            if (channel["name"] == "lit_environment") continue;  // the scene has none: black in all three
            EXPECT_EQ(channel["nearer"], "forward_plus") << "a packed G-buffer is further away";
            EXPECT_GT(channel["by"].get<double>(), 1);
            EXPECT_GT(channel["error"]["deferred"]["mean"].get<double>(),
                      channel["error"]["forward_plus"]["mean"].get<double>());
        }
    }
    EXPECT_NE(contentsOf(folder / "r/index.html").find(">Against the reference<"), std::string::npos);
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
    EXPECT_NE(page.find(">Against the reference<"), std::string::npos);
    EXPECT_EQ(page.find(".nearer.png\""), std::string::npos) << "its pictures are in it";
}

// Exit code 1, with a tolerance below float32's precision.
TEST(ReferenceTool, ADifferenceIsExitCodeOne) {
    const Folder folder;
    folder.write("none.json", R"({"rules": [{"channel": "lit", "max": 0, "because": "to fail"}]})");
    const Ran ran = runTool(folder,
                            "compare builtin:triangle --size 32x18 --runs 0 --baseline reference "
                            "--tolerances none.json -o r");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_EQ(readJson(folder / "r/report.json")["verdict"], "fail");
}

// ---- interrupted -------------------------------------------------------------------------------------

constexpr const char* panel =
    R"({"lights": [{"type": "rect", "position": [0, 3, 1], "direction": [0, -1, 0], "size": [2, 1],
                    "intensity": 100}]})";
std::vector<std::string> drawing(const std::string& size) {
    return {"render",
            "builtin:gallery",
            "--path",
            "reference",
            "--reference-mode",
            "scene",
            "--spp",
            "2",
            "--size",
            size,
            "--shadows",
            "pcf",
            "--lights",
            "panel.json",
            "-o",
            "r.exr"};
}
const std::vector<std::string> longDrawing = drawing("64x36");

// Calls `attempt` with a command to be interrupted, with more and more pixels until that succeeds, because
// the machine's speed and load are unknown. `attempt` begins in a fresh folder and returns false if the
// command finished first.
template <typename Attempt>
void untilCaughtAtWork(Attempt attempt) {
    for (const std::string size : {"64x36", "128x72", "256x144", "512x288", "1024x576"}) {
        const Folder folder;
        folder.write("panel.json", panel);
        if (attempt(folder, drawing(size)) || ::testing::Test::HasFailure()) return;
    }
    FAIL() << "too quick to be interrupted";
}

std::string inShell(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += word + " ";
    return line;
}

// The checkpoint files beside r.exr, sorted by name.
std::vector<fs::path> checkpointedIn(const Folder& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().filename().string().starts_with(".r.exr.reference-")) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// Indices of the complete tiles in a checkpoint file. Layout: a header (magic number, image key, floats of
// a tile), then for each tile its index, floats and checksum.
std::set<std::uint64_t> tilesIn(const fs::path& file) {
    const std::string bytes = contentsOf(file);
    const auto wordAt = [&](std::size_t at) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof word);
        return word;
    };
    std::set<std::uint64_t> tiles;
    if (bytes.size() < 24) return tiles;
    const std::size_t record = 8 + 4 * wordAt(16) + 8;
    for (std::size_t at = 24; at + record <= bytes.size(); at += record) tiles.insert(wordAt(at));
    return tiles;
}

bool endsAndGoesOn(const Folder& folder, const std::vector<std::string>& words, int signal, bool says) {
    Running tool(folder, words);
    const auto tiles = [&] {
        const std::vector<fs::path> kept = checkpointedIn(folder);
        return kept.empty() ? 0 : tilesIn(kept.front()).size();
    };
    EXPECT_TRUE(soon([&] { return tiles() > 0 || tool.ended(); })) << tool.err();
    if (tool.ended()) return false;
    ::kill(tool.process(), signal);
    EXPECT_TRUE(soon([&] { return tool.ended(); }));
    if (WIFEXITED(tool.wait()) && fs::exists(folder / "r.exr")) return false;
    EXPECT_TRUE(WIFSIGNALED(tool.wait()) && WTERMSIG(tool.wait()) == signal) << tool.wait();
    EXPECT_GT(tiles(), 0u) << "what is done is there";
    if (::testing::Test::HasFailure()) return false;
    const fs::path kept = checkpointedIn(folder).front();
    EXPECT_EQ(
        tool.err().find(kept.filename().string() + ": the same command resumes there") != std::string::npos,
        says)
        << tool.err();
    EXPECT_FALSE(fs::exists(folder / "r.exr"));
    // Finished tiles are not rendered again, and the result says so.
    const Ran again = runTool(folder, inShell(words));
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(
        std::regex_search(again.out + again.err,
                          std::regex("the reference resumed at [1-9][0-9]* %, which an interrupted command "
                                     "had rendered in [0-9]+:[0-9]+; the rest took [0-9]+:[0-9]+")))
        << again.out << again.err;
    EXPECT_FALSE(fs::exists(kept)) << "the picture is whole";

    fs::rename(folder / "r.exr", folder / "pieced.exr");
    const Ran at_once = runTool(folder, inShell(words));
    EXPECT_EQ(at_once.code, 0);
    EXPECT_EQ((at_once.out + at_once.err).find("resumed at"), std::string::npos);
    const Ran same = runTool(folder, "diff pieced.exr r.exr --metric max --tolerance 0 --json");
    EXPECT_EQ(same.code, 0) << same.out << same.err;
    return true;
}

// The estimate precedes the first tile, and is in the progress line.
TEST(ReferenceTool, SaysOnATerminalHowLongAllWillTake) {
    untilCaughtAtWork([](const Folder& folder, const std::vector<std::string>& words) {
        const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
        EXPECT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
        const std::regex estimate("reference: trace every pixel, about [0-9]+:[0-9]+ in all");
        std::string shown;
        Running tool(folder, words, ::ptsname(terminal));
        const auto said = [&] {
            char text[4096];
            for (ssize_t n = 0; (n = ::read(terminal, text, sizeof text)) > 0;)
                shown.append(text, static_cast<std::size_t>(n));
            return std::regex_search(shown, estimate);
        };
        EXPECT_TRUE(soon([&] { return said() || tool.ended(); }));
        const bool caught = !tool.ended() && said();  // while it is still rendering
        ::close(terminal);
        return caught;
    });
}

TEST(ReferenceTool, InterruptedItSaysWhereItsWorkIsAndGoesOn) {
    untilCaughtAtWork([](const Folder& folder, const std::vector<std::string>& words) {
        return endsAndGoesOn(folder, words, SIGINT, true);
    });
}

TEST(ReferenceTool, KilledItGoesOnAsWell) {
    untilCaughtAtWork([](const Folder& folder, const std::vector<std::string>& words) {
        return endsAndGoesOn(folder, words, SIGKILL, false);
    });
}

// Kills the tool once it has stored `min` tiles in a file that is not among `before`. Returns that file,
// or an empty path if the tool ended first.
fs::path killedAfter(Running& tool, const Folder& folder, const std::vector<fs::path>& before,
                     std::size_t min) {
    fs::path own;
    EXPECT_TRUE(soon([&] {
        for (const fs::path& file : checkpointedIn(folder))
            if (std::ranges::count(before, file) == 0 && tilesIn(file).size() >= min) own = file;
        return !own.empty() || tool.ended();
    })) << tool.err();
    if (tool.ended()) return {};
    ::kill(tool.process(), SIGKILL);
    return WIFSIGNALED(tool.wait()) ? own : fs::path();
}

// A different image starts a new checkpoint; the first one's is neither used nor lost.
bool keepsWhatIsOfAnotherImage(const Folder& folder, const std::vector<std::string>& words) {
    const std::string command = "render builtin:triangle --path reference --size 32x18 --force -o r.exr";
    const Ran first = runTool(folder, command);
    EXPECT_EQ(first.code, 0);
    EXPECT_EQ(first.err.find("kept from"), first.err.npos) << first.err;
    fs::rename(folder / "r.exr", folder / "sound.exr");

    Running other(folder, words);
    const fs::path kept = killedAfter(other, folder, {}, 1);
    if (kept.empty()) return false;
    const std::string held = contentsOf(kept);

    for (const std::string quiet : {"", " -q"}) {
        const Ran ran = runTool(folder, command + quiet);
        EXPECT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(runTool(folder, "diff sound.exr r.exr --metric max --tolerance 0").code, 0);
        EXPECT_EQ(checkpointedIn(folder), std::vector<fs::path>{kept})
            << "its own is removed, the other's is not";
        EXPECT_EQ(contentsOf(kept), held);
        const std::string line =
            "diptych: kept from other interrupted references: " + kept.filename().string() + ";";
        EXPECT_EQ(ran.err.find(line) != ran.err.npos, quiet.empty()) << ran.err;
    }
    // The command of the first image can still resume, and removes the file at its end.
    EXPECT_EQ(runTool(folder, inShell(words)).code, 0);
    EXPECT_TRUE(checkpointedIn(folder).empty());
    return true;
}

TEST(ReferenceTool, WhatIsKeptOfAnotherImageStaysAndIsNamed) {
    untilCaughtAtWork(keepsWhatIsOfAnotherImage);
}

// Two programs render the same image with the same -o and are both killed: no tile of either is lost.
bool keepTheirTilesApart(const Folder& folder, const std::vector<std::string>& words) {
    Running one(folder, words);
    EXPECT_TRUE(soon([&] {
        return one.ended() ||
               (!checkpointedIn(folder).empty() && !tilesIn(checkpointedIn(folder).front()).empty());
    }));
    if (one.ended()) return false;
    ::kill(one.process(), SIGSTOP);  // stopped with its file locked while the second runs
    const std::vector<fs::path> first = checkpointedIn(folder);
    if (first.empty()) return false;
    EXPECT_EQ(first.size(), 1u);
    const std::size_t before = tilesIn(first[0]).size();
    Running two(folder, words);
    const fs::path second = killedAfter(two, folder, first, before + 1);
    if (second.empty()) return false;
    ::kill(one.process(), SIGKILL);
    one.wait();
    std::set<std::uint64_t> done = tilesIn(first[0]);
    EXPECT_GE(tilesIn(second).size(), before) << "the second began with what the first had done";
    done.merge(tilesIn(second));

    // The next program moves all tiles into one file before it adds any.
    Running third(folder, words);
    EXPECT_TRUE(soon([&] { return third.ended() || checkpointedIn(folder).size() == 1; })) << third.err();
    ::kill(third.process(), SIGSTOP);
    if (third.ended()) return false;
    // Either file is possible: the system may release a killed program's lock after its exit is visible.
    const std::vector<fs::path> taken = checkpointedIn(folder);
    if (taken.empty()) return false;
    EXPECT_EQ(taken.size(), 1u);
    EXPECT_TRUE(std::ranges::includes(tilesIn(taken[0]), done));
    ::kill(third.process(), SIGKILL);
    third.wait();

    const Ran last = runTool(folder, inShell(words));
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_TRUE(checkpointedIn(folder).empty());
    fs::rename(folder / "r.exr", folder / "pieced.exr");
    EXPECT_EQ(runTool(folder, inShell(words)).code, 0);
    EXPECT_EQ(runTool(folder, "diff r.exr pieced.exr --metric max --tolerance 0").code, 0);
    return true;
}

TEST(ReferenceTool, TwoProgramsWithOneOutputKeepTheirTilesApart) {
    untilCaughtAtWork(keepTheirTilesApart);
}

// Both programs finish: each writes the complete image, one after the other, and nothing else is left.
TEST(ReferenceTool, TwoProgramsWithOneOutputBothFinish) {
    const Folder folder;
    folder.write("panel.json", panel);
    std::vector<std::string> words = longDrawing;
    std::ranges::replace(words, std::string("64x36"), std::string("32x18"));
    Running one(folder, words), two(folder, words);
    EXPECT_EQ(one.wait(), 0) << one.err();
    EXPECT_EQ(two.wait(), 0) << two.err();
    EXPECT_TRUE(checkpointedIn(folder).empty());
    EXPECT_TRUE(fs::exists(folder / "r.exr"));
}

}  // namespace
}  // namespace diptych
