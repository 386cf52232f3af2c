// SPDX-License-Identifier: MIT
// Behaviour common to all commands: help, bad input, outputs, interruption, documents. A row for each
// command.
#include "tests/support/campaign.h"
#include "tests/tool/faults.h"
#include "tests/tool/running.h"
#include "tests/tool/sweep.h"

#include <chrono>
#include <ostream>
#include <set>
#include <sstream>

namespace diptych {
namespace {

enum class Draws { nothing, scenes, window };
struct CommandRow {
    std::string name;
    Draws draws = Draws::nothing;
    std::vector<std::string> work{};  // takes half a second; empty: no output to be interrupted
    std::string file{};               // of the output: the bytes that --json prints
    std::set<std::string> empty{};    // JSON paths of strings in them that may be empty
    bool no_file = false;             // refuses -o
    std::string words{};              // needed beside its inputs
    std::string missing = "no/such";  // inputs that are not there
    std::string state{};              // ending of the folder with the work that an interruption leaves
    std::string kept{};               // member of the document: how much of it was used
};
void PrintTo(const CommandRow& row, std::ostream* out) {
    *out << row.name;
}

std::vector<CommandRow> commandRows() {
    using Words = std::vector<std::string>;
    const std::string sweepGrid =
        R"({"settings":{"path":["deferred","forward_plus"],"gbuffer":["compact","full"]}})";
    const Words sweepWork{"builtin:points", "--size", "32x18", "--runs", "5", "--grid", sweepGrid},
        compareWork{"builtin:points", "--size", "64x36", "--runs", "1"},
        renderWork{"builtin:points", "--size", "160x90", "--runs", "5"},
        explainWork{"builtin:points", "--gbuffer", "compact", "--size", "64x36"},
        auditWork{"builtin:triangle", "--size", "16x9", "--quantity", "offset,scale"},
        benchWork{"builtin:points", "--size", "32x18", "--runs", "2", "--light-counts", "1,4"};
    const std::set<std::string> compareEmpty{"/comparisons/*/camera/choice", "/frames/*/camera/choice"};
    return {
        {"compare", Draws::scenes, compareWork, "report.json", compareEmpty},
        {"render", Draws::scenes, renderWork, "", {"/frames/*/camera/choice"}},
        {"diff", Draws::nothing, {}, "", {}, false, "", "no/such no/other"},
        {"tradeoff",
         Draws::scenes,
         sweepWork,
         "tradeoff.json",
         {"/cameras/*"},
         false,
         "",
         "no/such",
         ".o.sweep",
         "rows_kept"},
        {"explain", Draws::scenes, explainWork, "explain.json"},
        {"choose", Draws::scenes, sweepWork, "", {}, false, "--max-error 1"},
        {"audit",
         Draws::scenes,
         auditWork,
         "audit.json",
         {"/quantities/*/unit"},
         false,
         "",
         "no/such",
         ".o.audit",
         "steps_kept"},
        {"plan", Draws::scenes, {}, "", {}, true},
        {"view", Draws::window},
        {"bench", Draws::scenes, benchWork, "", {"/conclusions/*/pass", "/layers/compiler"}},
        {"calibrate", Draws::nothing, {}, "", {}, true},
        {"merge"},
        {"submit"},
        {"accept"},
        {"devices", Draws::nothing, {}, "", {}, true, "", "--device no/such"},
    };
}

class EveryCommand : public testing::TestWithParam<CommandRow> {
protected:
    std::string line(const std::string& arguments) const {
        return row_.name + " " + row_.words + " " + arguments;
    }
    Ran run(const std::string& arguments) const { return runTool(folder_, line(arguments)); }
    // Paths below the folder, without those of the shell's output.
    std::set<std::string> written() const {
        std::set<std::string> paths;
        for (const auto& [path, text] : contentsBelow(folder_.path()))
            if (path != ".stdout" && path != ".stderr") paths.insert(path);
        return paths;
    }

    const CommandRow& row_ = GetParam();
    const Folder folder_;
};

TEST_P(EveryCommand, HelpsOnStdoutWithAnExample) {
    const Ran ran = runTool(folder_, row_.name + " --help");
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("Example: diptych " + row_.name), std::string::npos) << ran.out;
    EXPECT_EQ(ran.err, "");
    EXPECT_TRUE(runTool(folder_, row_.name + " --help >/dev/full")
                    .failedOver("stdout: cannot write: No space left on device"));
}

// Each is one line, with --json also in an object, and nothing is written.
TEST_P(EveryCommand, NamesBadInput) {
    folder_.write("empty.glb", "");
    folder_.write("bad.gltf", "{ \"asset\": ");
    std::vector<std::pair<std::string, std::string>> bad{{row_.missing, "no/such"},
                                                         {row_.missing + " --paint", "--paint"}};
    if (row_.draws != Draws::nothing)
        bad.insert(bad.end(), {{"empty.glb", "empty.glb: is empty"},
                               {"bad.gltf", "bad.gltf: is not JSON"},
                               {"builtin:nothing", "builtin:nothing: no such scene"},
                               {"--gbuffer huge", "--gbuffer huge"},
                               {"--size 0x9", "--size 0x9"},
                               {"builtin:triangle --msaa 3", "--msaa"},
                               {"builtin:triangle --device nosuch", "--device nosuch: no such device"}});
    if (row_.draws == Draws::scenes)
        bad.insert(bad.end(), {{"builtin:triangle --camera 99", "--camera \"99\""},
                               {"builtin:triangle --lights disco:3", "--lights disco:3"}});
    if (row_.no_file) bad.emplace_back(row_.missing + " -o p", "-o p: " + row_.name + " writes no file");
    const std::set<std::string> before = written();
    for (const auto& [words, fault] : bad) {
        const Ran ran = run(words + " --json");
        EXPECT_TRUE(ran.failedOver(fault)) << words;
        EXPECT_EQ("diptych: " + parsed(ran).value("error", "") + "\n", ran.err) << words;
        EXPECT_EQ(written(), before) << words;
    }
    EXPECT_EQ(run(row_.missing).out, "");
}

class WritingCommand : public EveryCommand {
protected:
    std::vector<std::string> work() const {
        std::vector<std::string> words{row_.name, "-q", "--json", "-o", "o"};
        std::istringstream needed(row_.words);
        for (std::string word; needed >> word;) words.push_back(word);
        words.insert(words.end(), row_.work.begin(), row_.work.end());
        return words;
    }
};

// Said before anything is drawn.
TEST_P(WritingCommand, LeavesFilesOfOthersAlone) {
    folder_.write("theirs/thesis.txt", "years of work");
    folder_.write("file", "");
    const std::set<std::string> before = written();
    EXPECT_TRUE(run("builtin:triangle -o theirs").failedOver("--force"));
    EXPECT_TRUE(run("builtin:triangle -o file/inside").failedOver("file/inside: Not a directory"));
    EXPECT_EQ(written(), before);
    EXPECT_EQ(contentsOf(folder_ / "theirs/thesis.txt"), "years of work");
}

// A signal leaves a whole output or none. Then the same command ends, and nothing of unfinished work is left.
// Its output is a document that states its schema.
TEST_P(WritingCommand, GoesOnAfterAnInterruption) {
    for (const auto& [signal, milliseconds] : {std::pair{SIGINT, 200}, {SIGTERM, 400}}) {
        Running tool(folder_, work());
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        if (!tool.ended()) ::kill(tool.process(), signal);
        ASSERT_TRUE(soon([&] { return tool.ended(); }));
        const bool died = WIFSIGNALED(tool.wait());
        EXPECT_TRUE(died || WEXITSTATUS(tool.wait()) == 0) << tool.err();
        if (died) {
            EXPECT_EQ(WTERMSIG(tool.wait()), signal);
            EXPECT_LE(std::ranges::count(tool.err(), '\n'), 1) << tool.err();
        }
        EXPECT_TRUE(leftoversIn(folder_.path()).empty()) << signal;
    }
    const Ran ran = runTool(folder_, shellWords(work()));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json document = parsed(ran);
    EXPECT_GE(document.value("schema", 0), 1);
    for (const std::string& path : emptyIn(document)) EXPECT_TRUE(row_.empty.contains(path)) << path;
    if (!row_.file.empty()) {
        EXPECT_TRUE(ran.out == contentsOf(folder_ / ("o/" + row_.file))) << "byte for byte";
    }
    EXPECT_EQ(diptych::namesIn(folder_.path()), (std::vector<std::string>{".stderr", ".stdout", "o"}));
}

#ifdef DIPTYCH_FAULTS
// Removes from a document what two runs do not share: times, what times decide, and counts of resumed rows.
Json timeless(Json document) {
    static const std::set<std::string> timed{
        "ms",         "passes",     "drawing_ms", "visits", "fronts",       "second_visit", "cost_ms",
        "made_in_ms", "compare_ms", "encode_ms",  "record", "object_lists", "rows_kept",    "steps_kept"};
    if (document.is_object())
        for (const std::string& key : timed) document.erase(key);
    if (document.is_array())
        std::erase_if(document.get_ref<Json::array_t&>(), [](const Json& value) {
            return value.is_string() && value.get<std::string>().starts_with("the reference resumed at ");
        });
    if (document.is_structured())
        for (Json& value : document) value = timeless(std::move(value));
    return document;
}

std::size_t storedIn(const fs::path& state) {
    std::size_t stored = 0;
    if (fs::exists(state))
        for (const auto& entry : fs::directory_iterator(state)) {
            const std::string name = entry.path().filename();
            stored += name.ends_with(".json") && name != "key.json" && name.front() != '.';
        }
    return stored;
}

// Killed before any file gets its name, the same command uses all that was stored and ends in the document of
// an undisturbed run, apart from times.
TEST_P(WritingCommand, EndsAsAnUndisturbedOneAfterAnyKill) {
    const std::string line = shellWords(work());
    const Json whole = timeless(parsed(runTool(folder_, line)));
    const bool decided_by_times = row_.name == "choose" || row_.name == "bench";
    const Rows rows(30);
    int killed = 0;
    for (int row = 0;; row = rows.after(row)) {
        fs::remove_all(folder_ / "o");
        const Faulted cut = runFaulted(folder_, line, {"move", "kill"}, 1 + row);
        if (cut.seen.empty()) break;
        ++killed;
        const std::size_t stored = storedIn(folder_ / row_.state);
        const Ran again = runTool(folder_, line);
        ASSERT_EQ(again.code, 0) << row << again.err;
        const Json document = parsed(again);
        if (!decided_by_times) {
            EXPECT_EQ(timeless(document), whole) << row;
        }
        if (!row_.kept.empty()) {
            EXPECT_EQ(document[row_.kept], stored) << row;
        }
        EXPECT_EQ(diptych::namesIn(folder_.path()), (std::vector<std::string>{".stderr", ".stdout", "o"}))
            << row;
    }
    EXPECT_GE(rows.atMost(killed), 4);
}
#endif

INSTANTIATE_TEST_SUITE_P(Row, EveryCommand, testing::ValuesIn(commandRows()),
                         [](const auto& row) { return row.param.name; });

std::vector<CommandRow> writingRows() {
    std::vector<CommandRow> rows = commandRows();
    std::erase_if(rows, [](const CommandRow& row) { return row.work.empty(); });
    return rows;
}
INSTANTIATE_TEST_SUITE_P(Row, WritingCommand, testing::ValuesIn(writingRows()),
                         [](const auto& row) { return row.param.name; });

// A new command needs a row.
TEST(Commands, HaveARowEach) {
    const Folder folder;
    const Ran ran = runTool(folder, "--help");
    EXPECT_EQ(ran.code, 0);
    std::istringstream lines(ran.out.substr(ran.out.find("Subcommands:\n") + 13));
    std::vector<std::string> listed, rows;
    for (std::string text; std::getline(lines, text) && text.starts_with("  ");)
        listed.push_back(text.substr(2, text.find(' ', 2) - 2));
    for (const CommandRow& row : commandRows()) rows.push_back(row.name);
    EXPECT_EQ(rows, listed);
    EXPECT_EQ(runTool(folder, "--version").code, 0);
    EXPECT_TRUE(runTool(folder, "").failedOver("--help"));
    EXPECT_TRUE(runTool(folder, "paint").failedOver("paint"));
    EXPECT_TRUE(runTool(folder, "--manual >/dev/full").failedOver("No space left on device"));
    EXPECT_TRUE(runTool(folder, "devices >/dev/full").failedOver("No space left on device"));
}

}  // namespace
}  // namespace diptych
