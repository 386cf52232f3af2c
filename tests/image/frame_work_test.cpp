// SPDX-License-Identifier: MIT
// Workload counts of a frame, on scenes whose counts are known.
#include "compare/render/frame_work.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "compare/render/renderer.h"
#include "compare/render/sample_counts.h"
#include "tests/image/scenes.h"

#include <algorithm>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

Settings countedSettings(Path path) {
    Settings settings;
    settings.path = path;
    settings.size = {160, 90};
    settings.shadows = Shadows::off;
    settings.prepass = Switch::off;
    return settings;
}

FrameWork workOf(const std::string& name, const Settings& settings) {
    const Scene scene = loadScene("builtin:" + name);
    SceneViews views(scene);
    return countWork(device(), views, {settings}).front();
}

PassWork passOf(const FrameWork& work, const std::string& name) {
    const auto found =
        std::ranges::find_if(work.passes, [&](const PassWork& pass) { return pass.counts.name == name; });
    EXPECT_NE(found, work.passes.end()) << name;
    return found == work.passes.end() ? PassWork{} : *found;
}

constexpr std::uint64_t pixels = 160 * 90;

// Squares side by side, without overlap.
TEST(FrameWork, CountsVerticesTrianglesAndFragments) {
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        const FrameWork work = workOf("array?objects=12&triangles=24", countedSettings(path));
        const PassWork drawn = passOf(work, path == Path::deferred ? "G-buffer" : "shade");
        EXPECT_EQ(drawn.counts.triangles, 24u);
        EXPECT_GE(drawn.counts.vertices, 48u);
        EXPECT_LE(drawn.counts.vertices, 72u) << "an index a corner at most";
        EXPECT_GT(drawn.counts.fragments, pixels / 4);
        EXPECT_LT(drawn.counts.fragments, pixels) << "squares leave some background";
        EXPECT_EQ(drawn.texels, 0) << "no material has a texture";
        EXPECT_GT(drawn.vertex_bytes, 0);
    }
}

// --prepass auto: the note and the passes are of one decision.
TEST(FrameWork, APrepassIsDrawnWhereItIsSaidToSaveTime) {
    Settings settings = countedSettings(Path::forward_plus);
    settings.prepass = Switch::automatic;
    for (const auto& [name, on] : {std::pair{"array?objects=12&triangles=24", false}, {"cutout", true}}) {
        const Scene scene = loadScene(std::string("builtin:") + name);
        SharedResources shared(device(), scene, pipelines());
        const SceneView view = makeSceneView(scene, viewRequest(settings));
        const PreparedFrame prepared(device(), shared, view, settings);
        EXPECT_EQ(std::ranges::count(prepared.passes.names(), "depth pre-pass"), on ? 1 : 0) << name;
        const std::string said = std::string("--prepass auto is ") + (on ? "on: " : "off: ");
        EXPECT_TRUE(std::ranges::any_of(prepared.view.details, [&](const std::string& line) {
            return line.starts_with(said);
        })) << name;
    }
}

TEST(FrameWork, AGBufferIsWrittenOnceAndReadOnce) {
    const Settings settings = countedSettings(Path::deferred);
    const FrameWork work = workOf("array", settings);
    const Scene scene = loadScene("builtin:array");
    SceneViews views(scene);
    Renderer renderer(device(), views);
    PreparedFrames frames = renderer.prepare(std::vector{settings});
    const std::uint64_t bytes = pixels * frames.described(0).bytes.gbuffer_per_pixel;
    EXPECT_EQ(passOf(work, "G-buffer").counts.written, bytes);
    EXPECT_EQ(passOf(work, "G-buffer").counts.read, 0u);
    EXPECT_EQ(passOf(work, "G-buffer").lights, 0);
    EXPECT_GE(passOf(work, "shade").counts.read, bytes);
    EXPECT_LE(passOf(work, "shade").counts.fragments, pixels);
    EXPECT_EQ(passOf(work, "shade").texels, 0);
    EXPECT_GT(passOf(work, "shade").lights, 0);
}

// Fragments that fail the depth test are not shaded: after a pre-pass each covered pixel is shaded once.
TEST(FrameWork, APrepassSavesFragments) {
    Settings settings = countedSettings(Path::forward_plus);
    const FrameWork without = workOf("gallery", settings);
    settings.prepass = Switch::on;
    const FrameWork with = workOf("gallery", settings);
    EXPECT_LT(passOf(with, "shade").counts.fragments, passOf(without, "shade").counts.fragments);
    EXPECT_EQ(passOf(with, "depth pre-pass").counts.fragments, 0u) << "no colour is drawn";
    EXPECT_GT(passOf(with, "depth pre-pass").counts.samples, 0u);
    EXPECT_GT(passOf(with, "shade").texels, 0);
}

TEST(FrameWork, SamplesAreNoFragments) {
    Settings settings = countedSettings(Path::forward_plus);
    const PassCounts one = passOf(workOf("array", settings), "shade").counts;
    settings = withSamples(settings, 4);
    const PassCounts four = passOf(workOf("array", settings), "shade").counts;
    EXPECT_NEAR(static_cast<double>(four.samples) / static_cast<double>(one.samples), 4, 0.1);
    EXPECT_NEAR(static_cast<double>(four.fragments) / static_cast<double>(one.fragments), 1, 0.03);
}

}  // namespace
}  // namespace diptych::tests
