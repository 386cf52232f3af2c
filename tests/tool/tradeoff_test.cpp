// SPDX-License-Identifier: MIT
// Sweeps through the whole program: their output, and the commands that it prints.
#include "tests/support/campaign.h"
#include "tests/tool/faults.h"
#include "tests/tool/running.h"
#include "tests/tool/sweep.h"

#include <sys/file.h>

#include <algorithm>
#include <set>

namespace diptych {
namespace {

// Runs "diptych WORDS" as printed, through the shell.
Ran runPrinted(const Folder& folder, const std::string& command, const std::string& more) {
    EXPECT_TRUE(command.starts_with("diptych ")) << command;
    return runTool(folder, command.substr(8) + " " + more);
}

TEST(Tradeoff, LeavesTableCsvJsonPlotsPageAndImages) {
    const Folder folder;
    const Ran ran = runTool(folder, sweep);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json tradeoff = readJson(folder / "t/tradeoff.json");
    EXPECT_EQ(ran.out, contentsOf(folder / "t/tradeoff.json")) << "--json prints it and nothing else";
    std::set<std::string> listed, there;
    for (const Json& name : tradeoff["files"]) listed.insert(name);
    for (const auto& entry : fs::directory_iterator(folder / "t")) there.insert(entry.path().filename());
    EXPECT_EQ(listed, there);
    for (const char* name : {"index.html", "tradeoff.csv", "flip.svg", "flip.deferred.svg",
                             "relative_p99.forward_plus.svg", "row-001.png", "reference.png"})
        EXPECT_TRUE(there.contains(name)) << name;
    const std::string csv = contentsOf(folder / "t/tradeoff.csv");
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(csv, '\n')), tradeoff["rows"].size() + 1);
    EXPECT_GT(tradeoff["rows"].size(), 12u);
    EXPECT_FALSE(tradeoff["skipped"].empty());
    for (const Json& row : tradeoff["rows"]) {
        EXPECT_GT(row["ms"]["median"], 0);
        EXPECT_LE(row["ms"]["min"], row["ms"]["median"]);
        EXPECT_LE(row["ms"]["median"], row["ms"]["max"]);
        EXPECT_GT(row["errors"]["flip"], 0) << "float against double";
        EXPECT_GT(row["bytes"]["images"], 0);
    }
    EXPECT_FALSE(fs::exists(folder / ".t.sweep")) << "what it kept is gone";
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
    // Forward+ at full size is closest to the reference; at a quarter of the size the error is large.
    EXPECT_LT(tradeoff["rows"][0]["errors"]["flip"], 1e-3);
    const auto quarter = std::ranges::find_if(tradeoff["rows"], [](const Json& row) {
        return row["differs"] == Json{{"path", "forward_plus"}, {"size", "8x6"}};
    });
    ASSERT_NE(quarter, tradeoff["rows"].end());
    EXPECT_GT((*quarter)["errors"]["flip"], 0.05);
}

TEST(Tradeoff, TheTableGrowsAndEndsWithTheFront) {
    const Folder folder;
    const Ran ran =
        runTool(folder,
                "tradeoff builtin:triangle --size 16x12 --runs 1 -o t "
                "--grid '{\"settings\":{\"path\":[\"deferred\",\"forward_plus\"],\"prepass\":\"off\"}}'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find(" row "), std::string::npos);
    EXPECT_NE(ran.out.find("forward_plus, prepass off\n"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("Pareto front of time and FLIP: row"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("deferred has no depth pre-pass: prepass off"), std::string::npos) << ran.out;
    const Ran verbose = runTool(folder,
                                "tradeoff builtin:triangle --size 16x12 --runs 1 -o t -v "
                                "--grid '{\"settings\":{\"path\":[\"deferred\"]}}'");
    EXPECT_NE(verbose.out.find("diptych tradeoff "), std::string::npos) << verbose.out;
}

TEST(Tradeoff, EveryRowIsReproducedByItsCommand) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, std::string(sweep) +
                                  "--spp 1 --lights point:3 --camera 'eye=0,0,3 target=0,0,0 fov=50' "
                                  "--camera 'eye=1,0,3 target=0,0,0'")
                  .code,
              0);
    const Json tradeoff = readJson(folder / "t/tradeoff.json");
    std::size_t compared = 0;
    const std::size_t step = isCampaign() ? 1 : 6;  // three commands a row
    for (std::size_t i = 0; i < tradeoff["rows"].size(); i += step) {
        const Json& row = tradeoff["rows"][i];
        ASSERT_EQ(row["cameras"].size(), 2u);
        const Ran again = runPrinted(folder, row["measure"], "-q -o again");
        ASSERT_EQ(again.code, 0) << again.err;
        const Json one = readJson(folder / "again/tradeoff.json");
        ASSERT_EQ(one["rows"].size(), 1u) << row["measure"];
        EXPECT_EQ(one["rows"][0]["errors"], row["errors"]) << row["measure"] << ": to the last bit";
        EXPECT_EQ(one["rows"][0]["settings"], row["settings"]);
        const Ran image = runPrinted(folder, row["render"], "-q --json --runs 0 -o picture");
        ASSERT_EQ(image.code, 0) << image.err;
        const Json frames = Json::parse(image.out)["frames"];
        ASSERT_EQ(frames.size(), 2u);
        EXPECT_EQ(frames[0]["settings"], row["settings"]) << row["render"];
        if (row["compare"].is_null()) continue;
        ++compared;
        const Ran report = runPrinted(folder, row["compare"], "-q --json --runs 0 --channels lit -o report");
        ASSERT_NE(report.code, 2) << report.err;
        // The report also has the other path; only this row's path is checked, for the first camera.
        bool found = false;
        const Json all = Json::parse(report.out);
        for (const Json& comparison : all["comparisons"])
            if (!found && comparison["baseline"] == "reference" &&
                comparison["test"] == row["settings"]["path"]) {
                found = true;
                EXPECT_NEAR(comparison["channels"][0]["flip"],
                            row["cameras"][0]["errors"]["flip"].get<double>(),
                            1e-3 * row["cameras"][0]["errors"]["flip"].get<double>());
                EXPECT_EQ(comparison["channels"][0]["rmse"], row["cameras"][0]["errors"]["relative_rmse"]);
            }
        EXPECT_TRUE(found) << row["compare"];
    }
    EXPECT_GT(compared, 1u);
}

TEST(Tradeoff, TwoToOnePlaceAreRefusedAndWhatIsNotOursIsLeft) {
    const Folder folder;
    fs::create_directories(folder / ".t.sweep");
    const int held = ::open((folder / ".t.sweep").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    EXPECT_TRUE(runTool(folder, std::string(sweep)).failedOver("another diptych"));
    ::close(held);
    folder.write(".t.sweep/notes.txt", "mine");
    EXPECT_TRUE(runTool(folder, std::string(sweep)).failedOver("not written by diptych"));
    EXPECT_EQ(contentsOf(folder / ".t.sweep/notes.txt"), "mine");
}

TEST(Tradeoff, SaysWhatLightTheRowsLeaveOut) {
    const Folder folder;
    folder.write("l.json", R"({"lights": [{"type": "directional", "angle": 0.0093, "intensity": 2}]})");
    const Ran ran = runTool(folder, std::string(sweep) + "--lights l.json --grid '{\"settings\":{}}'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(Json::parse(ran.out)["notes"].dump().find("not rendered by forward_plus yet"),
              std::string::npos)
        << ran.out;
}

TEST(Tradeoff, WhatItCannotDoIsOneLine) {
    const Folder folder;
    folder.write("grid.json", R"({"settings": {"gbuffer": ["tiny"]}})");
    const std::pair<const char*, const char*> bad[] = {
        {"--grid grid.json", "grid.json"},
        {"--grid nowhere.json", "no such file"},
        {"--runs 0", "--runs 0"},
        {"-o x.png", "-o x.png"},
        {"--path reference", "--path reference"},
        {"--spp 2", "--spp 2"},
        {"--grid '{\"settings\":{\"msaa_shading\":\"sample\"}}'", "--msaa-shading sample"}};
    for (const auto& [words, fault] : bad)
        EXPECT_TRUE(
            runTool(folder, std::string("tradeoff builtin:triangle --size 16x12 ") + words).failedOver(fault))
            << words;
    EXPECT_FALSE(fs::exists(folder / "diptych-tradeoff"));
}

// If the reader of the printed rows closes the pipe after the first, the output folder is still written.
TEST(Tradeoff, AClosedPipeDoesNotEndIt) {
    const Folder folder;
    const Ran ran = runShell(
        folder, "'" DIPTYCH_PROGRAM "' " + shellWords(longSweep) + " | head -n 2 | wc -l", folder.path());
    EXPECT_EQ(ran.out, "2\n") << ran.err;
    ASSERT_TRUE(soon([&] { return fs::exists(folder / "t/tradeoff.json"); }));
    EXPECT_EQ(readJson(folder / "t/tradeoff.json")["rows"].size(), 5u);
}

TEST(Tradeoff, ReplacesItsOwnFolder) {
    const Folder folder;
    const std::string grid = "--grid '{\"settings\":{}}'";
    ASSERT_EQ(runTool(folder, sweep).code, 0);
    ASSERT_TRUE(fs::exists(folder / "t/row-009.png"));
    ASSERT_EQ(runTool(folder, sweep + grid).code, 0);
    EXPECT_FALSE(fs::exists(folder / "t/row-009.png")) << "of the earlier sweep";
    EXPECT_EQ(readJson(folder / "t/tradeoff.json")["rows"].size(), 1u);
    folder.write("t/notes.txt", "mine");
    ASSERT_EQ(runTool(folder, sweep + grid).code, 0);
    EXPECT_EQ(contentsOf(folder / "t/notes.txt"), "mine");
}

}  // namespace
}  // namespace diptych
