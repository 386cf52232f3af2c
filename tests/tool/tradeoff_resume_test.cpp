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

// A row without the times, which differ between runs.
Json untimed(Json row) {
    for (const char* key : {"ms", "passes", "drawing_ms"}) row.erase(key);
    for (Json& camera : row["cameras"])
        for (const char* key : {"ms", "passes", "visits"}) camera.erase(key);
    return row;
}

Json untimedRows(const Json& tradeoff) {
    Json rows = Json::array();
    for (const Json& row : tradeoff["rows"]) rows.push_back(untimed(row));
    return rows;
}

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

// Starts the sweep and ends it with `signal` once `count` rows are stored. Returns the stored rows.
std::map<std::string, Json> cut(const Folder& folder, std::size_t count, int signal,
                                std::string* said = nullptr) {
    Running tool(folder, longSweep);
    EXPECT_TRUE(soon([&] { return tool.ended() || checkpointedIn(folder / ".t.sweep").size() >= count; }));
    EXPECT_FALSE(tool.ended()) << "too fast to be cut: " << tool.err();
    ::kill(tool.process(), signal);
    EXPECT_TRUE(soon([&] { return tool.ended(); }));
    if (said) *said = tool.err();
    return checkpointedIn(folder / ".t.sweep");
}

TEST(TradeoffResume, ASweepKilledAtAnyRowGoesOnToTheSameTable) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, shellWords(longSweep) + "-q").code, 0);
    const Json whole = readJson(folder / "t/tradeoff.json");
    ASSERT_EQ(whole["rows"].size(), 5u);
    for (std::size_t count = 0; count <= 5; ++count) {  // 5: while rows are timed again
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
                const Json &now = row["cameras"][0], &then = known->second["cameras"][0];
                EXPECT_EQ(now["visits"][0], then["visits"][0]) << "times of before are kept";
                EXPECT_EQ(now["passes"], then["passes"]);
                EXPECT_EQ(now["visits"].size(), 5u);
                int runs = 0;
                for (const Json& visit : now["visits"]) runs += visit["runs"].get<int>();
                EXPECT_EQ(runs, whole["runs"]) << "none is timed twice or left out";
            }
        EXPECT_EQ(same, kept.size());
        EXPECT_FALSE(fs::exists(folder / ".t.sweep"));
        EXPECT_TRUE(leftoversIn(folder.path()).empty());
    }
}

TEST(TradeoffResume, CtrlCSaysHowItGoesOn) {
    const Folder folder;
    std::string said;
    cut(folder, 1, SIGINT, &said);
    EXPECT_NE(said.find("the same command continues from there"), std::string::npos) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    EXPECT_TRUE(fs::exists(folder / ".t.sweep/key.json"));
}

TEST(TradeoffResume, AnotherSweepStartsAnew) {
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

TEST(TradeoffResume, ARecordThatIsNotWholeIsMeasuredAgain) {
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
    const std::size_t whole = checkpointedIn(folder / ".t.sweep").size();  // one of them lacks its image
    ASSERT_EQ(runTool(folder, shellWords(longSweep) + "-q").code, 0);
    EXPECT_EQ(readJson(folder / "t/tradeoff.json")["rows_kept"], whole - 1);
}

}  // namespace
}  // namespace diptych
