// SPDX-License-Identifier: MIT
// Sweeps through the whole program: what they leave, what their commands do, and how they go on.
#include "shared/frame/settings.h"
#include "tests/tool/faults.h"
#include "tests/tool/running.h"

#include <sys/file.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <map>
#include <set>

namespace diptych {
namespace {

using Json = nlohmann::json;

Json readJson(const fs::path& file) {
    return Json::parse(contentsOf(file), nullptr, false);
}

// A row without what two runs may time differently.
Json untimed(Json row) {
    for (const char* key : {"ms", "passes", "drawing_ms"}) row.erase(key);
    for (Json& camera : row["cameras"])
        for (const char* key : {"ms", "passes"}) camera.erase(key);
    return row;
}

Json untimedRows(const Json& tradeoff) {
    Json rows = Json::array();
    for (const Json& row : tradeoff["rows"]) rows.push_back(untimed(row));
    return rows;
}

// "diptych WORDS" as it is printed, through the shell.
Ran runPrinted(const Folder& folder, const std::string& command, const std::string& more) {
    EXPECT_TRUE(command.starts_with("diptych ")) << command;
    return runTool(folder, command.substr(8) + " " + more);
}

constexpr const char* sweep = "tradeoff builtin:triangle --size 32x24 --runs 2 --json -q -o t ";

TEST(Tradeoff, LeavesTableCsvJsonPlotsPageAndPictures) {
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
    // Forward+ of full size is nearest to the truth, a quarter of the size far from it.
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
    EXPECT_NE(ran.out.find("forward_plus, prepass off  diptych tradeoff --runs 1 --grid "), std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find("front of time and FLIP: row "), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("not drawn: prepass off: deferred has no depth pre-pass"), std::string::npos)
        << ran.out;
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
    for (std::size_t i = 0; i < tradeoff["rows"].size(); i += 3) {
        const Json& row = tradeoff["rows"][i];
        ASSERT_EQ(row["cameras"].size(), 2u);
        const Ran again = runPrinted(folder, row["measure"], "-q -o again");
        ASSERT_EQ(again.code, 0) << again.err;
        const Json one = readJson(folder / "again/tradeoff.json");
        ASSERT_EQ(one["rows"].size(), 1u) << row["measure"];
        EXPECT_EQ(one["rows"][0]["errors"], row["errors"]) << row["measure"] << ": to the last bit";
        EXPECT_EQ(one["rows"][0]["settings"], row["settings"]);
        const Ran picture = runPrinted(folder, row["render"], "-q --json --runs 0 -o picture");
        ASSERT_EQ(picture.code, 0) << picture.err;
        const Json frames = Json::parse(picture.out)["frames"];
        ASSERT_EQ(frames.size(), 2u);
        EXPECT_EQ(frames[0]["settings"], row["settings"]) << row["render"];
        if (row["compare"].is_null()) continue;
        ++compared;
        const Ran report = runPrinted(folder, row["compare"], "-q --json --runs 0 --channels lit -o report");
        ASSERT_NE(report.code, 2) << report.err;
        // Its report has the other path, too: the one of this row, of the first camera.
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

// ---- Going on

const std::vector<std::string> longSweep{
    "tradeoff",
    "builtin:triangle",
    "--size",
    "64x48",
    "--runs",
    "60",
    "-o",
    "t",
    "--grid",
    R"([{"settings": {"path": ["deferred", "forward_plus"], "size": ["1/2", "1/1"]}}, {"settings": {"prepass": "off"}}])"};

std::string shellWords(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += "'" + word + "' ";
    return line;
}

// Rows that the sweep keeps, by their Settings.
std::map<std::string, Json> keptIn(const fs::path& state) {
    std::map<std::string, Json> rows;
    std::error_code ignored;
    for (fs::directory_iterator entry(state, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->path().extension() == ".json" && entry->path().filename() != "key.json" &&
            entry->path().filename().string().front() != '.')
            if (const Json row = readJson(entry->path()); row.is_object()) rows[row["settings"].dump()] = row;
    return rows;
}

// Starts the sweep and lets `signal` end it once `count` rows are kept. Returns those that were.
std::map<std::string, Json> cut(const Folder& folder, std::size_t count, int signal,
                                std::string* said = nullptr) {
    Running tool(folder, longSweep);
    EXPECT_TRUE(soon([&] { return tool.ended() || keptIn(folder / ".t.sweep").size() >= count; }));
    EXPECT_FALSE(tool.ended()) << "too fast to be cut: " << tool.err();
    ::kill(tool.process(), signal);
    EXPECT_TRUE(soon([&] { return tool.ended(); }));
    if (said) *said = tool.err();
    return keptIn(folder / ".t.sweep");
}

TEST(Tradeoff, ASweepKilledAtAnyRowGoesOnToTheSameTable) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, shellWords(longSweep) + "-q").code, 0);
    const Json whole = readJson(folder / "t/tradeoff.json");
    ASSERT_EQ(whole["rows"].size(), 5u);
    for (std::size_t count = 0; count < 5; ++count) {
        fs::remove_all(folder / "t");
        const std::map<std::string, Json> kept = cut(folder, count, SIGKILL);
        ASSERT_GE(kept.size(), count);
        EXPECT_FALSE(fs::exists(folder / "t")) << "nothing half done under its name";
        const Ran ran = runTool(folder, shellWords(longSweep) + "-q");
        ASSERT_EQ(ran.code, 0) << ran.err;
        const Json resumed = readJson(folder / "t/tradeoff.json");
        EXPECT_EQ(untimedRows(resumed), untimedRows(whole)) << count;
        EXPECT_EQ(resumed["rows_kept"], kept.size());
        std::size_t same = 0;
        for (const Json& row : resumed["rows"])
            if (const auto known = kept.find(row["settings"].dump()); known != kept.end()) {
                ++same;
                EXPECT_EQ(row["ms"], known->second["ms"]) << "times of rows measured before are kept";
                EXPECT_EQ(row["cameras"], known->second["cameras"]);
            }
        EXPECT_EQ(same, kept.size());
        EXPECT_FALSE(fs::exists(folder / ".t.sweep"));
        EXPECT_TRUE(leftoversIn(folder.path()).empty());
    }
}

TEST(Tradeoff, CtrlCSaysHowItGoesOn) {
    const Folder folder;
    std::string said;
    cut(folder, 1, SIGINT, &said);
    EXPECT_NE(said.find("the same command goes on from there"), std::string::npos) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    EXPECT_TRUE(fs::exists(folder / ".t.sweep/key.json"));
}

TEST(Tradeoff, AnotherSweepStartsAnew) {
    const Folder folder;
    cut(folder, 2, SIGKILL);
    std::vector<std::string> other = longSweep;
    other[5] = "2";  // runs
    const Ran ran = runTool(folder, shellWords(other));
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("anew"), std::string::npos) << ran.err;
    const Json tradeoff = readJson(folder / "t/tradeoff.json");
    EXPECT_EQ(tradeoff["rows_kept"], 0);
    for (const Json& row : tradeoff["rows"]) EXPECT_EQ(row["cameras"][0]["ms"]["runs"], 2);
}

TEST(Tradeoff, ARecordThatIsNotWholeIsMeasuredAgain) {
    const Folder folder;
    ASSERT_GE(cut(folder, 3, SIGKILL).size(), 3u);
    std::size_t damaged = 0;
    for (const auto& entry : fs::directory_iterator(folder / ".t.sweep")) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".json") || name == "key.json" || name.front() == '.' || damaged == 2) continue;
        if (damaged++ == 0)
            std::ofstream(entry.path()) << contentsOf(entry.path()).substr(0, 100);
        else
            fs::remove(entry.path().parent_path() / (entry.path().stem().string() + ".png"));
    }
    ASSERT_EQ(damaged, 2u);
    const std::size_t whole = keptIn(folder / ".t.sweep").size();  // of those one lacks its picture
    ASSERT_EQ(runTool(folder, shellWords(longSweep) + "-q").code, 0);
    EXPECT_EQ(readJson(folder / "t/tradeoff.json")["rows_kept"], whole - 1);
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

TEST(Tradeoff, WhatItCannotDoIsOneLine) {
    const Folder folder;
    folder.write("grid.json", R"({"settings": {"gbuffer": ["tiny"]}})");
    folder.write("mine/notes.txt", "mine");
    const std::pair<const char*, const char*> bad[] = {
        {"--grid grid.json", "grid.json"},
        {"--grid nowhere.json", "cannot be read"},
        {"builtin:spheres", "one scene"},
        {"--runs 0", "--runs 0"},
        {"-o x.png", "-o x.png"},
        {"-o mine", "--force"},
        {"--path reference", "--path reference"},
        {"--spp 2", "--spp 2"},
        {"--grid '{\"settings\":{\"shadows\":\"evsm\"}}'", "--shadows evsm"},
        {"--camera 7", "7"}};
    for (const auto& [words, fault] : bad)
        EXPECT_TRUE(
            runTool(folder, std::string("tradeoff builtin:triangle --size 16x12 ") + words).failedOver(fault))
            << words;
    EXPECT_FALSE(fs::exists(folder / "diptych-tradeoff"));
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
