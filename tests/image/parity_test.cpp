// SPDX-License-Identifier: MIT
// Both paths draw the same picture: bit for bit with a float32 G-buffer, and with a packed one differing by
// exactly what the encoding does.
#include "shared/scene/load.h"
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

class BuiltinParity : public testing::TestWithParam<std::string> {};
class AssetParity : public testing::TestWithParam<std::string> {};

void expectBitEqual(const Scene& scene, const Settings& settings) {
    const std::vector<Frame> frames = bothPaths(scene, settings);
    expectSameChannels(frames[0], frames[1]);
    for (const Frame& frame : frames) {
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u)
            << frame.name << ": the capture must reproduce the timed lit";
        EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << frame.name;
    }
}

// What forward+ computes from an encoded and decoded surface is what deferred shows: nothing else differs.
void expectExplained(const Scene& scene, const Settings& settings) {
    const std::vector<Frame> frames = bothPaths(scene, settings);
    ASSERT_EQ(frames[1].through_gbuffer.size(), litModes.size());
    for (const auto& [mode, image] : frames[1].through_gbuffer)
        EXPECT_EQ(differingPixels(frames[0].channels.at(mode), image), 0u) << debugMode(mode).name;
    for (const int mode :
         {8, 10, 11, 12})  // ids, depth, position, geometric normal: the same in any encoding
        EXPECT_EQ(differingPixels(frames[0].channels.at(mode), frames[1].channels.at(mode)), 0u)
            << debugMode(mode).name;
    EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u);
}

TEST_P(BuiltinParity, FullIsBitEqual) {
    expectBitEqual(loadScene(GetParam()), smallPicture(GBufferEncoding::full));
}

TEST_P(BuiltinParity, PackedDiffersByItsEncodingAlone) {
    const Scene scene = loadScene(GetParam());
    for (const GBufferEncoding encoding : {GBufferEncoding::standard, GBufferEncoding::compact})
        expectExplained(scene, smallPicture(encoding));
}

TEST_P(BuiltinParity, PrepassNeverChangesThePicture) {
    const Scene scene = loadScene(GetParam());
    RenderOptions options;
    options.channels = allChannels();
    options.runs = 0;
    std::vector<Settings> settings(2, smallPicture(GBufferEncoding::standard));
    settings[0].prepass = Switch::on;
    settings[1].prepass = Switch::off;
    const std::vector<Frame> frames = renderAll(device(), scene, settings, options);
    expectSameChannels(frames[0], frames[1]);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BuiltinParity, testing::ValuesIn(builtinScenes()),
                         [](const auto& scene) { return testName(scene.param.substr(8)); });

TEST_P(AssetParity, FullIsBitEqualAndPackedIsExplained) {
    const std::filesystem::path file = assets() / GetParam();
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << file << "; the built-in scenes prove it";
    const Scene scene = loadScene(file.string());
    Settings settings = smallPicture(GBufferEncoding::full);
    settings.size = {320, 180};
    settings.lights = "point:12,spot:4";
    expectBitEqual(scene, settings);
    settings.gbuffer = GBufferEncoding::standard;
    expectExplained(scene, settings);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AssetParity, testing::ValuesIn(assetScenes()), [](const auto& scene) {
    return testName(std::filesystem::path(scene.param).stem().string());
});

// Light from everywhere goes through the same table in both.
TEST(Parity, OfAmbientLight) {
    for (const char* name :
         {"builtin:gallery", "builtin:dielectrics", "builtin:occlusion", "builtin:ortho"}) {
        const Scene scene = loadScene(name);
        for (const GBufferEncoding encoding :
             {GBufferEncoding::full, GBufferEncoding::standard, GBufferEncoding::compact}) {
            Settings settings = smallPicture(encoding);
            settings.ambient = {0.3f, 0.4f, 0.5f};
            encoding == GBufferEncoding::full ? expectBitEqual(scene, settings)
                                              : expectExplained(scene, settings);
        }
    }
}

// The twins: each changes one constant in what one path draws, and the gate above must notice.
class ParityTwin : public testing::Test {
protected:
    static std::size_t changedPixels(const Scene& a, const Scene& b, int mode) {
        const Settings settings = smallPicture(GBufferEncoding::full);
        return differingPixels(bothPaths(a, settings)[0].channels.at(mode),
                               bothPaths(b, settings)[1].channels.at(mode));
    }
    const Scene scene = loadScene("builtin:gallery");
    Scene changed = scene;
};

TEST_F(ParityTwin, OneLightInAThousandthIsSeen) {
    changed.lights.back().intensity *= 1.001f;
    EXPECT_GT(changedPixels(scene, changed, 0), 0u);
}

TEST_F(ParityTwin, OneUlpOfAlbedoIsSeen) {
    for (Material& m : changed.materials) m.base_color.r = std::nextafter(m.base_color.r, 0.0f);
    EXPECT_GT(changedPixels(scene, changed, 1), 0u);
}

TEST_F(ParityTwin, OneUlpOfRoughnessIsSeen) {
    for (Material& m : changed.materials) m.roughness = std::nextafter(m.roughness, 0.0f);
    EXPECT_GT(changedPixels(scene, changed, 4), 0u);
    EXPECT_GT(changedPixels(scene, changed, 0), 0u) << "and in lit";
}

TEST_F(ParityTwin, APackedGBufferIsSeenByTheFullGate) {
    const Frame full = bothPaths(scene, smallPicture(GBufferEncoding::full))[1];
    const Frame packed = bothPaths(scene, smallPicture(GBufferEncoding::standard))[0];
    for (const int mode : {0, 1, 2, 4, 40, 41})
        EXPECT_GT(differingPixels(full.channels.at(mode), packed.channels.at(mode)), 0u)
            << debugMode(mode).name;
}

TEST_F(ParityTwin, AnotherEncodingIsNotTheExplanation) {
    const Frame compact = bothPaths(scene, smallPicture(GBufferEncoding::compact))[0];
    const Frame standard = bothPaths(scene, smallPicture(GBufferEncoding::standard))[1];
    EXPECT_GT(differingPixels(compact.channels.at(0), standard.through_gbuffer.at(0)), 0u);
}

}  // namespace
}  // namespace diptych::tests
