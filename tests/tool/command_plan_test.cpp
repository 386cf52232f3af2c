// SPDX-License-Identifier: MIT
// diptych plan: what it says of a scene and each path.
#include "tests/tool/run.h"
#include "tests/tool/sweep.h"

namespace diptych {
namespace {

TEST(Command, PlanSaysWhatIsModelledAndWhatEachPathCosts) {
    const Folder folder;
    const Ran ran = runTool(folder, "plan --json builtin:gallery");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const Json scene = parsed(ran)["scenes"][0];
    EXPECT_EQ(scene["scene"], "builtin:gallery");
    EXPECT_FALSE(scene["modelled"].empty());
    ASSERT_EQ(scene["paths"].size(), 2u);
    // depth, compared with depth and a G-buffer
    EXPECT_GT(scene["paths"][0]["bytes_per_pixel"], scene["paths"][1]["bytes_per_pixel"]);
    const std::string sentence = runTool(folder, "plan builtin:triangle").out;
    EXPECT_NE(sentence.find("4 bytes per pixel, 20 with lighting; 16 and 96 with --msaa 4"),
              std::string::npos)
        << sentence;
    // Buffers with one element per pixel are divided by the pixel count, without the padding of rows.
    ASSERT_EQ(scene["paths"][0]["samples"][1]["samples"], 4);
    EXPECT_EQ(scene["paths"][0]["samples"][1]["image_bytes_per_pixel"], 252);
    // A forward+ sample has 4 bytes of depth and 16 of light; a multisampled pixel has 16 more, for
    // resolved light.
    const Json samples = scene["paths"][1]["samples"];
    ASSERT_GE(samples.size(), 2u);
    EXPECT_EQ(samples[0]["image_bytes_per_pixel"], 20);
    EXPECT_EQ(scene["paths"][0]["samples"][0]["bytes_per_pixel"], 28) << "five words, of normals two; depth";
    for (const Json& of : samples) {
        const int count = of["samples"];
        EXPECT_EQ(of["bytes_per_pixel"], 4 * count);
        EXPECT_EQ(of["bytes_per_sample"], 4);
        EXPECT_EQ(of["image_bytes_per_pixel"], 20 * count + (count > 1 ? 16 : 0));
    }
    EXPECT_EQ(samples[1]["samples"], 4);
}

// Paths share pipelines, but each path's plan is independent of the other paths requested.
TEST(Command, PlanSaysOfAPathTheSameAloneAndBesideAnother) {
    const Folder folder;
    const Json both = parsed(runTool(folder, "plan --json builtin:points"))["scenes"][0]["paths"];
    ASSERT_EQ(both.size(), 2u);
    for (const Json& path : both) {
        const std::string name = path["path"];
        EXPECT_EQ(parsed(runTool(folder, "plan --json builtin:points --path " + name))["scenes"][0]["paths"],
                  Json::array({path}))
            << name;
        EXPECT_NE(path["notes"].dump().find(" pipelines"), std::string::npos);
        EXPECT_EQ(path["notes"].dump().find(" 0 pipelines"), std::string::npos);
    }
}

}  // namespace
}  // namespace diptych
