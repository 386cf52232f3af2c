// SPDX-License-Identifier: MIT
// audit as users run it: output folder, exit code, and resuming after an interruption.
#include "tests/tool/faults.h"
#include "tests/tool/sweep.h"

namespace diptych {
namespace {

TEST(AuditTool, AFolderOfPlotsAndTablesAndAnExitCode) {
    const Folder folder;
    const Ran ran =
        runTool(folder,
                "audit builtin:triangle --size 16x9 --quantity offset,environment,distance,haze --require "
                "offset=1e7 -o out");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("pass: offset as far as 1e+07"), ran.out.npos) << ran.out;
    EXPECT_NE(ran.out.find("environment: not varied: the scene has no environment"), ran.out.npos) << ran.out;
    for (const char* file : {"index.html", "audit.json", "audit.csv", "offset.svg", "haze.svg"})
        EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
    EXPECT_FALSE(fs::exists(folder / "out/environment.svg"));
    EXPECT_FALSE(fs::exists(folder / ".out.audit"));
    const Json audit = readJson(folder / "out/audit.json");
    EXPECT_EQ(audit["software"], "diptych");
    EXPECT_EQ(emptyIn(audit), (std::set<std::string>{"/quantities/*/unit", "/requirements/*/because"}));
    EXPECT_EQ(audit["quantities"].size(), 4u);
    EXPECT_EQ(audit["requirements"][0]["met"], true);
    // Every printed failure is reduced to a file whose command reproduces it.
    std::size_t shown = 0;
    for (const Json& quantity : audit["quantities"])
        for (const Json& failure : quantity.value("failures", Json::array())) {
            EXPECT_NE(failure["words"].get<std::string>().find("1 triangle"), std::string::npos) << failure;
            const std::string command = failure["command"];
            ASSERT_EQ(command.find("diptych "), 0u) << failure;
            EXPECT_EQ(runTool(folder, command.substr(8) + " --runs 0 -q --force -o shown").code, 1)
                << command;
            ++shown;
        }
    EXPECT_EQ(shown, 2u) << "distance and haze";
}

TEST(AuditTool, WhatIsNotReachedIsSaid) {
    const Folder folder;
    const Ran ran =
        runTool(folder, "audit builtin:triangle --size 32x18 --quantity haze --require haze=1e12 -o out");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("FAIL: haze as far as 1e+12"), ran.out.npos) << ran.out;
    EXPECT_NE(contentsOf(folder / "out/index.html").find("verdict fail"), std::string::npos);
}

TEST(AuditTool, RelationsThatHold) {
    const Folder folder;
    const Ran ran = runTool(
        folder,
        "audit builtin:points --size 32x18 --relations --relation moved,lights_split,still_time -o out");
    ASSERT_EQ(ran.code, 0) << ran.err << ran.out;
    EXPECT_NE(ran.out.find("pass: 3 of 3 relations hold, 0 broken, 0 not applicable"), ran.out.npos)
        << ran.out;
    for (const char* file : {"index.html", "relations.json"})
        EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
    const Json json = readJson(folder / "out/relations.json");
    EXPECT_EQ(json["software"], "diptych");
    EXPECT_EQ(json["verdict"], "pass");
    ASSERT_EQ(json["relations"].size(), 3u);
    EXPECT_EQ(json["relations"][0]["name"], "lights_split");
    EXPECT_EQ(json["relations"][0]["series"].size(), 4u);
    EXPECT_EQ(json["relations"][0]["series"][3]["path"], "reference");
    // The same command replaces its own folder; quantities are a different command.
    const Ran again = runTool(folder, "audit builtin:points --size 32x18 --relation repeated --json -o out");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(Json::parse(again.out)["relations"].size(), 1u);
    EXPECT_EQ(runTool(folder, "audit builtin:points --relations --quantity offset").code, 2);
    EXPECT_EQ(runTool(folder, "audit builtin:points --relations --require offset=1").code, 2);
    const Ran unknown = runTool(folder, "audit builtin:points --relation move");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.err.find("did you mean moved?"), unknown.err.npos) << unknown.err;
    const Ran quiet =
        runTool(folder, "audit builtin:triangle --size 32x18 --relation lights_permuted -q -o none");
    EXPECT_EQ(quiet.code, 0) << quiet.err;
    EXPECT_EQ(quiet.out, "");
    EXPECT_EQ(readJson(folder / "none/relations.json")["relations"][0]["verdict"], "does not apply");
}

#ifdef DIPTYCH_FAULTS
std::size_t stepsIn(const fs::path& state) {
    std::size_t steps = 0;
    std::error_code ignored;
    for (fs::directory_iterator entry(state, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename();
        steps += name.ends_with(".json") && name != "key.json" && name.front() != '.';
    }
    return steps;
}

// Users can read finished plots while audit measures the rest; the page says what is pending. After a kill,
// audit measures only what is missing.
TEST(AuditTool, TheFirstPlotIsThereBeforeTheLast) {
    const Folder folder;
    const std::string words = "audit builtin:triangle --size 16x9 -o t --quantity offset,scale,intensity ";
    // The key's move, ten steps', five files' and the folder's; then steps of scale.
    const std::string anew =
        "the results of an interrupted audit belong to another scene, device or Settings; starting anew";
    const Faulted first = runFaulted(folder, words + "--gbuffer full", {"move", "kill"}, 3);
    EXPECT_EQ(first.err.find(anew), first.err.npos) << first.err;
    const Faulted cut = runFaulted(folder, words, {"move", "kill"}, 25);
    EXPECT_NE(cut.err.find(anew), cut.err.npos) << cut.err;
    const Json sofar = readJson(folder / "t/audit.json");
    ASSERT_EQ(sofar["to_come"], (Json{"scale", "intensity"})) << cut.seen;
    EXPECT_EQ(sofar["quantities"].size(), 1u);
    EXPECT_TRUE(fs::exists(folder / "t/offset.svg"));
    EXPECT_NE(contentsOf(folder / "t/index.html").find("still being measured"), std::string::npos);
    const std::size_t kept = stepsIn(folder / ".t.audit");
    const Ran ran = runTool(folder, words + "-v");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json whole = readJson(folder / "t/audit.json");
    EXPECT_TRUE(whole["to_come"].empty());
    EXPECT_EQ(whole["quantities"].size(), 3u);
    EXPECT_EQ(whole["steps_kept"], kept);
    EXPECT_NE(ran.err.find(fmt::format("{} steps kept from an interrupted run", kept)), ran.err.npos)
        << ran.err;
    EXPECT_TRUE(fs::exists(folder / "t/intensity.svg"));
    EXPECT_FALSE(fs::exists(folder / ".t.audit"));
    // Continues at the step whose file did not get its name: "move scale-VALUE.json".
    const std::size_t value = cut.seen.find("scale-") + 6;
    const std::string next = "scale " + cut.seen.substr(value, cut.seen.find(".json") - value) + " ";
    EXPECT_EQ(ran.err.find("offset "), ran.err.npos) << ran.err;
    EXPECT_EQ(ran.err.find("scale "), ran.err.find(next)) << next << ran.err;
}
#endif

}  // namespace
}  // namespace diptych
