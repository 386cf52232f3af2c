// SPDX-License-Identifier: MIT
// Scenes with extreme values, through the whole program: either both paths render them, or there is a
// one-line error.
#include "tests/support/campaign.h"
#include "tests/tool/run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

// glTF with these nodes, all of them roots, and one mesh: a triangle in the plane z = 0, or other
// positions (base64 of 36 bytes).
std::string sceneOf(const std::string& nodes, std::size_t count,
                    const std::string& positions = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
                    int vertices = 3) {
    std::string roots;
    for (std::size_t i = 0; i < count; ++i) roots += (i ? "," : "") + std::to_string(i);
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + roots +
           R"(]}], "nodes": [)" + nodes + R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": )" +
           std::to_string(vertices) + R"(, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,)" +
           positions + R"("}]})";
}

void expectParity(const Folder& folder, const std::string& name, const std::string& scene,
                  const char* options = "") {
    folder.write(name, scene);
    fs::remove_all(folder / "report");
    const Ran ran = runTool(folder, "compare " + name + " --size 64x36 --runs 0 -q -o report " + options);
    EXPECT_EQ(ran.code, 0) << name << ": " << ran.err;
    EXPECT_TRUE(fs::exists(folder / "report" / "index.html")) << name;
}

TEST(ExtremeScenes, SmallLargeAndFarAway) {
    const Folder folder;
    for (const char* scale : {"1e-3", "1", "1e4"})
        for (const char* offset : {"0", "1e4", "1e7", "-1e9"})
            expectParity(
                folder, fmt::format("scale{}at{}.gltf", scale, offset),
                sceneOf(
                    fmt::format(R"({{"mesh": 0, "scale": [{0}, {0}, {0}], "translation": [{1}, {1}, {1}]}})",
                                scale, offset),
                    1));
}

// Squared lengths underflow float32; lighting still is finite, with every type of light.
TEST(ExtremeScenes, SoSmallThatSquaresVanish) {
    const Folder folder;
    for (const char* scale : {"1e-20", "1e-30", "1e-35"}) {
        folder.write("small.gltf",
                     sceneOf(fmt::format(R"({{"mesh": 0, "scale": [{0}, {0}, {0}]}})", scale), 1));
        const Ran ran =
            runTool(folder,
                    "compare small.gltf --size 64x36 --runs 0 -q --force --ambient 1,1,1 --haze on "
                    "--lights point:4 -o report");
        EXPECT_EQ(ran.code, 0) << scale << ": " << ran.err;
    }
}

// Radiance beyond float32's range fails; outputs have replacements, and the report counts their pixels.
TEST(ExtremeScenes, LightThatFloat32CannotHold) {
    const Folder folder;
    folder.write("bright.gltf", sceneOf(R"({"mesh": 0})", 1));
    folder.write("lights.json",
                 R"({"lights": [{"type": "point", "intensity": 3e38, "position": [0.2, 0.2, 0.01]}]})");
    const Ran ran = runTool(folder,
                            "compare bright.gltf --size 64x36 --runs 0 --lights lights.json --camera "
                            "\"eye=0.3,0.3,2 target=0.3,0.3,0\" -o report --json");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(contentsOf(folder / "report/index.html").find("replaced by 0 or the largest number"),
              std::string::npos);
    const nlohmann::json report = nlohmann::json::parse(ran.out, nullptr, false);
    ASSERT_TRUE(report.is_object()) << ran.out;
    for (const auto& frame : report["frames"]) {
        EXPECT_GT(frame["counters"]["nonfinite_pixels"].get<int>(), 0);
        EXPECT_EQ(frame["repaired"]["lit"]["pixels"], frame["counters"]["nonfinite_pixels"]);
    }
    const Ran render = runTool(folder,
                               "render bright.gltf --size 64x36 --runs 0 --lights lights.json --camera "
                               "\"eye=0.3,0.3,2 target=0.3,0.3,0\" -o bright.png");
    EXPECT_EQ(render.code, 0) << render.err;
    EXPECT_NE(render.out.find("note: lit was NaN or infinite at "), render.out.npos) << render.out;
    for (const char* name : {"deferred", "forward_plus"}) {
        const Ran diff =
            runTool(folder, fmt::format("diff report/{0}.exr report/{0}.exr --channels lit --json", name));
        EXPECT_EQ(diff.code, 0) << diff.err;
        EXPECT_EQ(diff.out.find("NaN"), diff.out.npos) << diff.out;
    }
}

TEST(ExtremeScenes, NothingToDraw) {
    const Folder folder;
    const char* const empty = "--allow-empty";
    expectParity(folder, "no-node.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})",
                 empty);
    expectParity(folder, "no-scene.gltf", R"({"asset": {"version": "2.0"}})", empty);
    expectParity(folder, "no-mesh.gltf",
                 R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}]})",
                 empty);
    expectParity(folder, "one-vertex.gltf",
                 sceneOf(R"({"mesh": 0})", 1, "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA", 1), empty);
    expectParity(folder, "one-place.gltf", sceneOf(R"({"mesh": 0})", 1, std::string(48, 'A')), empty);
}

// More draw calls than 16 bits count; a full run renders a million.
TEST(ExtremeScenes, AHundredThousandDraws) {
    const Folder folder;
    const std::size_t count = isCampaign() ? 1000000 : 100000;
    std::string nodes;
    for (std::size_t i = 0; i < count; ++i)
        nodes +=
            fmt::format(R"({}{{"mesh": 0, "translation": [{}, {}, 0]}})", i ? "," : "", i % 1000, i / 1000);
    folder.write("many.gltf", sceneOf(nodes, count));
    const Ran ran = runTool(folder, "render many.gltf --size 64x36 --runs 0 -q -o many.png");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder / "many.png"));
}

}  // namespace
}  // namespace diptych
