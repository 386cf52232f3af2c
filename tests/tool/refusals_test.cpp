// SPDX-License-Identifier: MIT
// Refused inputs, for all or one of several scenes; and sharing an exposure.
#include "tests/tool/run.h"

#include <sys/stat.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Json = nlohmann::json;

// One unreadable scene does not end a comparison of several.
TEST(Refusals, OneBadSceneOfSeveralIsAnError) {
    const Folder folder;
    folder.write("bad.glb", "no glTF");
    folder.write("worse.glb", "no glTF either");
    const Ran ran =
        runTool(folder, "compare builtin:triangle bad.glb builtin:suns --size 16x9 --runs 0 -o out");
    EXPECT_EQ(ran.code, 2);
    EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
    EXPECT_TRUE(ran.err.starts_with("diptych: bad.glb: is not JSON")) << ran.err;
    EXPECT_NE(ran.out.find("\nERROR bad.glb: is not JSON"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("\nERROR: 1 scene could not be rendered: bad.glb; pass: all "), std::string::npos)
        << ran.out;
    const Json report = Json::parse(contentsOf(folder / "out/report.json"));
    EXPECT_EQ(report["comparisons"].size(), 2u);
    EXPECT_EQ(report["errors"][0]["scene"], "bad.glb");
    EXPECT_EQ(report["verdict"], "fail");
    // Alone, given twice (which is one scene), or with other unreadable ones: one line, and no report.
    EXPECT_TRUE(runTool(folder, "compare bad.glb -o none").failedOver("bad.glb: is not JSON"));
    EXPECT_TRUE(runTool(folder, "compare bad.glb bad.glb -o none").failedOver("bad.glb: is not JSON"));
    EXPECT_TRUE(runTool(folder, "compare bad.glb worse.glb -o none").failedOver("none of 2 scenes"));
    EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(Refusals, AnOutputThatCannotBeWrittenIsSaidBeforeRendering) {
    const Folder folder;
    folder.write("file", "");
    fs::create_symlink("loop", folder / "loop");
    fs::create_symlink("loop.exr", folder / "loop.exr");
    ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
    // Before rendering: a missing scene would be an error, too.
    for (const auto& [out, why] :
         {std::pair{"/dev/stdout | cat", "-o /dev/stdout: is a device, pipe or socket"},
          {"/dev/stdout > file", "-o /dev/stdout: is a file, but a folder is written there"},
          {"loop", "-o loop: its links lead in a circle"},
          {"loop/inside", "-o loop/inside: its links lead in a circle"},
          {"loop.exr", "-o loop.exr: its links lead in a circle"},
          {"pipe.png", "-o pipe.png: is a device, pipe or socket"},
          {"file/inside.png", "file/inside.png: Not a directory"}})
        for (const char* force : {"", "--force "})
            EXPECT_NE(runTool(folder, std::string("render none.gltf ") + force + "-o " + out)
                          .err.find(std::string("diptych: ") + why),
                      std::string::npos)
                << out;
}

// An image takes the exposure of another.
TEST(Refusals, ExposuresAreSaidAndShared) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render --path deferred builtin:spots --size 16x9 --runs 0 -o a.exr").code, 0);
    const std::string compare = "compare builtin:suns --size 16x9 --runs 0 -o out";
    const auto line = [](const std::string& text) {
        const std::size_t at = text.find("\npictures: ");
        return text.substr(at, text.find('\n', at + 1) - at);
    };
    const std::string own = line(runTool(folder, compare).out),
                      matched = line(runTool(folder, compare + " --match-exposure a.exr").out),
                      spots = line(runTool(folder, "compare builtin:spots --size 16x9 --runs 0 -o out").out);
    EXPECT_NE(own.find("automatic"), std::string::npos) << own;
    EXPECT_NE(matched.find(", as set"), std::string::npos) << matched;
    const auto factor = [](const std::string& text) {
        const std::size_t at = text.find("exposure ") + 9;
        return text.substr(at, text.find(',', at) - at);
    };
    EXPECT_EQ(factor(matched), factor(spots));
    EXPECT_NE(factor(matched), factor(own));
    ASSERT_EQ(runTool(folder, "render builtin:spots --size 16x9 --runs 0 -o a.png").code, 0);
    EXPECT_TRUE(runTool(folder, compare + " --match-exposure a.png").failedOver("holds display colours"));
}

// A reference with one sample a pixel, or fewer than a path has, is no ground truth for MSAA.
TEST(Refusals, SamplesNeedATruthOfSamples) {
    const Folder folder;
    const std::string compare =
        "compare builtin:triangle --size 16x9 --runs 0 --msaa 4 --baseline reference ";
    EXPECT_TRUE(runTool(folder, compare)
                    .failedOver("--msaa 4: --reference-mode surface shades one surface per pixel; use "
                                "--reference-mode scene --spp 64"));
    EXPECT_TRUE(runTool(folder, compare + "--reference-mode scene --spp 2").failedOver("use --spp 64"));
    EXPECT_TRUE(runTool(folder, compare + "--reference-mode scene --spp 64 --channels albedo")
                    .failedOver("--msaa 4: only lit is compared with the reference; add it to --channels"));
    ASSERT_EQ(runTool(folder,
                      "render builtin:triangle --size 16x9 --path reference --reference-mode scene -o r.exr")
                  .code,
              0);
    EXPECT_TRUE(runTool(folder, "compare builtin:triangle --size 16x9 --runs 0 --msaa 4 --baseline r.exr")
                    .failedOver("--msaa 4: the reference takes only 1 sample per pixel; use --spp 64"));
    EXPECT_FALSE(fs::exists(folder / "diptych-report"));
}

}  // namespace
}  // namespace diptych
