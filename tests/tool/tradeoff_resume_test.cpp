// SPDX-License-Identifier: MIT
// Interrupted sweeps, and how they are resumed.
#include "tests/tool/faults.h"
#include "tests/tool/running.h"
#include "tests/tool/sweep.h"

#include <algorithm>
#include <csignal>
#include <map>

namespace diptych {
namespace {

#ifdef DIPTYCH_FAULTS
// The rows that the sweep has stored, by their Settings.
std::map<std::string, Json> checkpointedIn(const fs::path& state) {
    std::map<std::string, Json> rows;
    std::error_code ignored;
    for (fs::directory_iterator entry(state, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->path().extension() == ".json" && entry->path().filename() != "key.json" &&
            entry->path().filename().string().front() != '.')
            if (const Json row = readJson(entry->path()); row.is_object()) rows[row["settings"].dump()] = row;
    return rows;
}

const std::string fiveRows =
    R"(tradeoff builtin:triangle --size 32x24 -o t --grid '[{"settings": {
        "path": ["deferred", "forward_plus"], "size": ["1/2", "1/1"]}},
        {"settings": {"prepass": "off"}}]' --runs )";
const std::string tenRuns = fiveRows + "10 -q";

// Kills the sweep once `count` rows are stored, each by three moves of files, after the key. Returns the
// stored rows.
std::map<std::string, Json> cut(const Folder& folder, int count) {
    const Faulted ran = runFaulted(folder, tenRuns, {"move", "kill"}, 2 + 3 * count);
    EXPECT_FALSE(ran.seen.empty()) << ran.err;
    return checkpointedIn(folder / ".t.sweep");
}

TEST(TradeoffResume, TimesOfBeforeAreKeptAndNoneIsMeasuredTwice) {
    const Folder folder;
    for (const int count : {0, 3, 5}) {  // 5: as rows are timed again
        fs::remove_all(folder / "t");
        const std::map<std::string, Json> kept = cut(folder, count);
        ASSERT_EQ(kept.size(), static_cast<std::size_t>(count));
        EXPECT_FALSE(fs::exists(folder / "t")) << "nothing half done under its name";
        const Ran ran = runTool(folder, tenRuns);
        ASSERT_EQ(ran.code, 0) << ran.err;
        const Json resumed = readJson(folder / "t/tradeoff.json");
        ASSERT_EQ(resumed["rows"].size(), 5u);
        EXPECT_EQ(resumed["rows_kept"], count);
        int same = 0;
        for (const Json& row : resumed["rows"]) {
            const Json& now = row["cameras"][0];
            int runs = 0;
            for (const Json& visit : now["visits"]) runs += visit["runs"].get<int>();
            EXPECT_EQ(runs, 10) << "none is timed twice or left out";
            if (const auto known = kept.find(row["settings"].dump()); known != kept.end()) {
                ++same;
                const Json& then = known->second["cameras"][0];
                EXPECT_EQ(now["visits"][0], then["visits"][0]) << "times of before are kept";
                EXPECT_EQ(now["passes"], then["passes"]);
            }
        }
        EXPECT_EQ(same, count);
    }
}

TEST(TradeoffResume, AnotherSweepStartsAnew) {
    const Folder folder;
    cut(folder, 2);
    const Ran ran = runTool(folder, fiveRows + "2");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("the results of an interrupted sweep belong to another scene, device or Settings; "
                           "starting anew"),
              std::string::npos)
        << ran.err;
    const Json tradeoff = readJson(folder / "t/tradeoff.json");
    EXPECT_EQ(tradeoff["rows_kept"], 0);
    for (const Json& row : tradeoff["rows"]) EXPECT_EQ(row["cameras"][0]["ms"]["runs"], 2);
}

TEST(TradeoffResume, ARecordThatIsNotWholeIsMeasuredAgain) {
    const Folder folder;
    ASSERT_EQ(cut(folder, 3).size(), 3u);
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
    ASSERT_EQ(runTool(folder, tenRuns).code, 0);
    EXPECT_EQ(readJson(folder / "t/tradeoff.json")["rows_kept"], 1);
}
#endif

// A longer one, if the machine is so fast that it ends first.
TEST(TradeoffResume, CtrlCSaysHowItGoesOn) {
    for (const char* runs : {"300", "3000", "30000"}) {
        const Folder folder;
        std::vector<std::string> words = longSweep;
        words[5] = runs;
        Running tool(folder, words);
        EXPECT_TRUE(soon([&] { return tool.ended() || fs::exists(folder / ".t.sweep/key.json"); }));
        if (tool.ended()) continue;
        ::kill(tool.process(), SIGINT);
        EXPECT_TRUE(soon([&] { return tool.ended(); }));
        if (!WIFSIGNALED(tool.wait())) continue;
        EXPECT_NE(tool.err().find("the same command continues from there"), std::string::npos) << tool.err();
        EXPECT_EQ(std::ranges::count(tool.err(), '\n'), 1) << tool.err();
        EXPECT_TRUE(fs::exists(folder / ".t.sweep/key.json"));
        return;
    }
    FAIL() << "too quick to be interrupted";
}

}  // namespace
}  // namespace diptych
