// SPDX-License-Identifier: MIT
// --strict as scripts see it: exit codes and lines.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

namespace diptych {
namespace {

TEST(StrictTool, DiffFailsOverAChannelOfOneFile) {
    const Folder folder;
    const Image grey(8, 4, 3, 0.5f), one(8, 4, 1, 1.0f);
    writeExr(folder / "a.exr", {{{"R", "G", "B"}, &grey}});
    writeExr(folder / "b.exr", {{{"R", "G", "B"}, &grey}, {{"metallic.Y"}, &one}});
    for (const auto& [files, line] : {std::pair{"a.exr b.exr", "metallic is in the test only"},
                                      {"b.exr a.exr", "metallic is in the reference only"}}) {
        const std::string command = std::string("diff ") + files;
        Ran ran = runTool(folder, command);
        EXPECT_EQ(ran.code, 0) << ran.out;
        EXPECT_NE(ran.out.find(std::string("\nnote: ") + line + ": not compared\n"), std::string::npos)
            << ran.out;
        ran = runTool(folder, command + " --strict");
        EXPECT_EQ(ran.code, 1) << ran.out;
        EXPECT_NE(ran.out.find(std::string("  FAIL ") + (files[0] == 'a' ? "a.exr: " : "b.exr: ") + line),
                  std::string::npos)
            << ran.out;
        ran = runTool(folder, command + " --strict -q -o report");
        EXPECT_EQ(ran.code, 1);
        const auto report = nlohmann::json::parse(contentsOf(folder / "report/report.json"));
        EXPECT_EQ(report["verdict"], "fail");
        EXPECT_NE(contentsOf(folder / "report/index.html").find("metallic is in the"), std::string::npos);
        EXPECT_NE(contentsOf(folder / "report/junit.xml").find("--strict"), std::string::npos)
            << "the command that repeats it";
    }
    EXPECT_EQ(runTool(folder, "diff b.exr b.exr --strict").code, 0);
    EXPECT_EQ(runTool(folder, "diff a.exr b.exr --strict --channels lit").code, 0)
        << "alike in what was asked for";
}

TEST(StrictTool, CompareFailsOverAChannelThatTheBaselineLacks) {
    const Folder folder;
    const std::string size = " builtin:points --size 16x9 --runs 0 ";
    ASSERT_EQ(runTool(folder, "render" + size + "--path deferred --channels lit,normals -q -o b.exr").code,
              0);
    const std::string command = "compare" + size + "--baseline b.exr ";
    Ran ran = runTool(folder, command);
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("\nnote: albedo is in deferred only: not compared\n"), std::string::npos)
        << ran.out;
    ran = runTool(folder, command + "--strict");
    EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("  FAIL builtin:points: albedo is in deferred only, but --strict requires"),
              std::string::npos)
        << ran.out;
    ran = runTool(folder, command + "--channels lit,normals,albedo");
    EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("  FAIL builtin:points: albedo is in deferred only, but --channels requests it\n"),
              std::string::npos)
        << ran.out;
    ran = runTool(folder, "compare" + size + "--baseline b.exr --channels lit,normals --strict");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

// A misspelled rule stops compare before rendering.
TEST(StrictTool, CompareRefusesARuleForNoChannel) {
    const Folder folder;
    folder.write("t.json", R"({"rules": [{"channel": "albdeo", "max": 1, "because": "any"}]})");
    EXPECT_TRUE(runTool(folder, "compare builtin:points --size 16x9 --runs 0 --tolerances t.json")
                    .failedOver("t.json, rule 1: no channel is called albdeo; did you mean albedo?"));
    EXPECT_FALSE(fs::exists(folder / "diptych-report"));
}

}  // namespace
}  // namespace diptych
