// SPDX-License-Identifier: MIT
// The explanation of a lit difference in a report.
#include "tests/tool/running.h"
#include "tests/tool/sweep.h"

#include <algorithm>
#include <set>

namespace diptych {
namespace {

const std::string view = "builtin:points --size 64x36 --gbuffer compact";

bool lists(const Json& report, const std::string& file) {
    return std::ranges::any_of(report["files"], [&](const Json& name) { return name == file; });
}

TEST(ExplainedReport, NamesTheCausesWhereItIsAskedTo) {
    const Folder folder;
    const Ran plain = runTool(folder, "compare " + view + " --runs 0 -o plain");
    const Ran ran = runTool(folder, "compare " + view + " --runs 0 --explain -o why");
    EXPECT_EQ(ran.code, plain.code) << "no verdict depends on it: " << ran.err;
    EXPECT_NE(ran.out.find("lit differs because of albedo"), std::string::npos) << ran.out;
    EXPECT_EQ(plain.out.find("because of albedo"), std::string::npos);
    const Json report = readJson(folder / "why/report.json"), before = readJson(folder / "plain/report.json");
    EXPECT_TRUE(before["comparisons"][0]["explanation"].is_null());
    EXPECT_FALSE(lists(before, "causes.png"));
    EXPECT_TRUE(lists(report, "causes.png"));
    const Json& found = report["comparisons"][0]["explanation"];
    const Ran explained = runTool(folder, "explain " + view + " --json");
    ASSERT_EQ(explained.code, 0) << explained.err;
    EXPECT_EQ(found["causes"], parsed(explained)["causes"]) << "to the last bit";
    EXPECT_EQ(report["comparisons"][0]["channels"], before["comparisons"][0]["channels"]);
    const std::string page = contentsOf(folder / "why/index.html");
    EXPECT_NE(page.find("src=\"causes.png\""), std::string::npos);
    EXPECT_NE(page.find("Why lit differs"), std::string::npos);
    EXPECT_EQ(contentsOf(folder / "plain/index.html").find("Why lit differs"), std::string::npos);
    // The command on the page gives the same explanation.
    const std::string again = found["command"];
    const Ran repeated = runTool(folder, again.substr(again.find(' ') + 1) + " --json");
    EXPECT_EQ(parsed(repeated)["causes"], found["causes"]) << again;
}

TEST(ExplainedReport, NamesTheCausesWhereLitFails) {
    const Folder folder;
    folder.write("t.json", R"({"rules": [{"channel": "lit", "max": 1e-9, "because": "a test"}]})");
    // Renders channels that the explanation needs, even if they are not requested.
    const Ran ran = runTool(
        folder, "compare " + view + " --runs 0 --channels lit --tolerances t.json --single-file -o why");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("because of albedo"), std::string::npos) << ran.out;
    const Json report = readJson(folder / "why/report.json");
    EXPECT_GE(report["comparisons"][0]["explanation"]["causes"].size(), 2u);
    EXPECT_FALSE(lists(report, "causes.png"));
    EXPECT_EQ(contentsOf(folder / "why/index.html").find("causes.png"), std::string::npos)
        << "it is in the page itself";
}

TEST(ExplainedReport, SaysWhyNotWhereItCannot) {
    const Folder folder;
    const std::string small = "builtin:triangle --size 16x9 --runs 0 ";
    ASSERT_EQ(runTool(folder, "render builtin:triangle --size 16x9 --channels lit,depth -o few.exr").code, 0);
    for (const std::string baseline : {"reference", "few.exr"}) {
        const Ran ran = runTool(folder, "compare " + small + "--explain --baseline " + baseline + " -o why");
        ASSERT_LE(ran.code, 1) << ran.err;
        const Json report = readJson(folder / "why/report.json");
        ASSERT_EQ(report["comparisons"].size(), 3u);
        std::set<bool> known;
        for (const Json& comparison : report["comparisons"])
            known.insert(!comparison["explanation"].contains("not_explained"));
        EXPECT_EQ(known.size(), 2u) << baseline << ": the comparison of both paths is explained";
        EXPECT_NE(ran.out.find("differences in lit cannot be explained: "), std::string::npos) << ran.out;
    }
}

}  // namespace
}  // namespace diptych
