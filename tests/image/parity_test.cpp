// SPDX-License-Identifier: MIT
// Both paths draw the same image: bit for bit with a float32 G-buffer; with a packed one they differ by
// exactly the effect of its encoding.
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/encoding_use.h"
#include "shared/scene/load.h"
#include "tests/image/verdicts.h"

#include <set>
#include <utility>

namespace diptych::tests {
namespace {

class BuiltinParity : public SceneTest {};
class StandardParity : public SceneTest {};
class AssetParity : public SceneTest {};
class LayeredParity : public SceneTest {};

void expectBitEqual(const std::vector<Frame>& frames, std::size_t minChannels = 14) {
    expectSameChannels(frames[0], frames[1], minChannels);
    for (const Frame& frame : frames) {
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u)
            << frame.name << ": the capture must reproduce the timed lit";
        EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << frame.name;
    }
}

// Deferred must equal what forward+ computes from surfaces that were encoded and decoded: there is no other
// difference.
void expectExplainedLight(const std::vector<Frame>& frames) {
    const auto made = [&](Channel mode) { return frames[0].channels.contains(mode); };
    ASSERT_EQ(static_cast<std::ptrdiff_t>(frames[1].through_gbuffer.size()),
              std::ranges::count_if(litModes, made));
    ASSERT_GE(frames[1].through_gbuffer.size(), 5u);
    for (const auto& [mode, image] : frames[1].through_gbuffer)
        EXPECT_EQ(differingPixels(frames[0].channels.at(mode), image), 0u) << debugMode(mode).name;
    EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u);
}

// Channels of light that scenes without layers have.
std::size_t litWithoutLayers() {
    return static_cast<std::size_t>(
        std::ranges::count_if(litModes, [](Channel mode) { return layerOf(mode) == 0; }));
}

void expectExplained(const std::vector<Frame>& frames) {
    expectExplainedLight(frames);
    Requirements all;
    all.emission = all.lightmap = all.dielectric_specular = true;
    all.surface_layers = gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN |
                         gpu::LAYER_IRIDESCENCE | gpu::LAYER_DIFFUSE_TRANSMISSION;
    all.min_emission = all.max_emission = all.max_lightmap = 1;
    const Coverage covered = coverage(frames[0], frames[1]);
    for (const Channel mode : lightingFields())
        if (const auto use = encodingUse(debugMode(mode), FramePair{frames[0], frames[1], all, covered})) {
            EXPECT_LE(use->used, 1) << debugMode(mode).name;
        }
    // ids, depth, position and whether there is a lightmap do not depend on the encoding.
    for (const Channel mode : {Channel::material_id, Channel::depth, Channel::position, Channel::lightmapped})
        EXPECT_EQ(differingPixels(frames[0], frames[1], mode), 0u) << debugMode(mode).name;
}

// The verdict that users see, at the tolerances of the encoding.
void expectPass(const std::vector<Frame>& frames, const Scene& scene) {
    const Report report = verdictOn(frames, scene);
    EXPECT_TRUE(report.passed()) << failuresOf(report);
    ASSERT_EQ(report.comparisons.size(), 1u);
    for (const ChannelDiff& channel : report.comparisons[0].channels)
        EXPECT_FALSE(channel.tolerance.because.empty());
}

void expectFullParity(UploadedScene& scene, const Settings& settings) {
    const std::vector<Frame>& frames = scene.bothPaths(settings);
    expectBitEqual(frames);
    expectPass(frames, scene.scene);
}

void expectPackedParity(UploadedScene& scene, const Settings& settings) {
    const std::vector<Frame>& frames = scene.bothPaths(settings);
    expectExplained(frames);
    expectPass(frames, scene.scene);
}

TEST_P(BuiltinParity, FullIsBitEqual) {
    expectFullParity(uploaded(GetParam()), smallImage(GBufferEncoding::full));
}

TEST_P(BuiltinParity, CompactDiffersByItsEncodingAlone) {
    expectPackedParity(uploaded(GetParam()), smallImage(GBufferEncoding::compact));
}

INSTANTIATE_TEST_SUITE_P(Builtin, BuiltinParity, testing::ValuesIn(builtinScenes()), sceneName);

TEST_P(StandardParity, DiffersByItsEncodingAlone) {
    expectPackedParity(uploaded(GetParam()), smallImage(GBufferEncoding::standard));
}

TEST_P(StandardParity, APrepassNeverChangesTheImage) {
    const RenderOptions options = untimed(allChannels());
    Settings with = smallImage(GBufferEncoding::standard), without = with;
    with.prepass = Switch::on;
    without.prepass = Switch::off;
    Renderer& renderer = uploaded(GetParam()).renderer;
    expectSameChannels(renderer.draw(with, options), renderer.draw(without, options));
}

INSTANTIATE_TEST_SUITE_P(Builtin, StandardParity, testing::ValuesIn(slice(builtinScenes(), 3)), sceneName);

TEST_P(AssetParity, FullIsBitEqualAndPackedIsExplained) {
    UploadedScene& scene = uploaded(name());
    expectFullParity(scene, assetImage(GBufferEncoding::full));
    expectPackedParity(scene, assetImage(GBufferEncoding::standard));
    expectPackedParity(scene, assetImage(GBufferEncoding::compact));
}

INSTANTIATE_TEST_SUITE_P(Asset, AssetParity, testing::ValuesIn(slice(assetScenes(), 4)), sceneName);

// Every channel of every material extension.
TEST_P(LayeredParity, FullIsBitEqualAndPackedIsExplained) {
    UploadedScene scene(name());
    Settings full = assetImage(GBufferEncoding::full);
    for (const Layers layers : {Layers::gbuffer, Layers::forward}) {
        full.layers = layers;
        expectBitEqual(scene.bothPaths(full));
    }
    expectExplained(scene.bothPaths(assetImage(GBufferEncoding::standard)));
}

INSTANTIATE_TEST_SUITE_P(Asset, LayeredParity, testing::ValuesIn(slice(layeredScenes(), 4)), sceneName);

TEST(DrawnTwice, NothingOrLitOrEveryChannel) {
    Settings settings = smallImage(GBufferEncoding::standard);
    RenderOptions options = untimed({Channel::lit, Channel::albedo, Channel::depth});
    const std::pair<Twice, std::set<Channel>> cases[] = {
        {Twice::none, {}},
        {Twice::lit, {Channel::lit}},
        {Twice::all, {Channel::lit, Channel::albedo, Channel::depth}}};
    for (const auto& [twice, channels] : cases) {
        options.twice = twice;
        std::set<Channel> drawn;
        const Frame frame = uploaded("builtin:gallery").renderer.draw(settings, options);
        EXPECT_EQ(frame.changed_buffers, std::vector<std::string>());
        for (const auto& [mode, noise] : frame.noise) {
            EXPECT_EQ(noise.pixels, 0u) << debugMode(mode).name;
            drawn.insert(mode);
        }
        EXPECT_EQ(drawn, channels);
    }
}

// Where no other channel is asked for, nothing is captured, and lit is the same.
TEST(DrawnTwice, LitAloneIsDrawnOnce) {
    const Scene scene = loadScene("builtin:spheres");
    Renderer renderer(device(), scene);
    Settings settings = smallImage(GBufferEncoding::standard);
    RenderOptions options = untimed({Channel::lit});
    const Image alone = renderer.draw(settings, options).channels.at(Channel::lit);
    const std::size_t pipelines = renderer.pipelines();
    options.channels.push_back(Channel::albedo);
    EXPECT_EQ(differingPixels(alone, renderer.draw(settings, options).channels.at(Channel::lit)), 0u);
    EXPECT_GT(renderer.pipelines(), pipelines);
}

// With a light that both paths shade by one table, of `encodings`.
void expectParity(const char* name, const Settings& requested,
                  std::initializer_list<GBufferEncoding> encodings) {
    for (const GBufferEncoding encoding : encodings) {
        Settings settings = requested;
        settings.gbuffer = encoding;
        const std::vector<Frame> frames =
            bothPaths(uploaded(name).renderer, settings, {litModes.begin(), litModes.end()});
        encoding == GBufferEncoding::full ? expectBitEqual(frames, litWithoutLayers())
                                          : expectExplainedLight(frames);
    }
}

// Ambient light uses the same table in both paths. It changes the channels of lighting only.
TEST(Parity, OfAmbientLight) {
    using enum GBufferEncoding;
    Settings settings = smallImage(full);
    settings.ambient = {0.3f, 0.4f, 0.5f};
    expectParity("builtin:gallery", settings, {full});
    expectParity("builtin:dielectrics", settings, {full, standard, compact});
    expectParity("builtin:occlusion", settings, {standard});
    expectParity("builtin:ortho", settings, {compact});
}

// One table and one formula, of every kind of light: encodings move the compensation as they move what it
// compensates.
TEST(Parity, OfLightBetweenMicrofacets) {
    using enum GBufferEncoding;
    Settings settings = with(smallImage(full), "ambient 0.3,0.4,0.5 multiscatter fdez");
    expectParity("builtin:gallery", settings, {full});
    expectParity("builtin:normals", settings, {full, standard, compact});
    settings.multiscatter = Multiscatter::energy;
    expectParity("builtin:dielectrics", settings, {full, standard, compact});
    expectParity("builtin:areas", settings, {full, compact});
}

// Pipelines that shade a surface as it is do not depend on the encoding: another one compiles anew only those
// that encode surfaces.
TEST(Parity, AnotherEncodingCompilesAgainWhatEncodesAlone) {
    const Scene scene = loadScene("builtin:triangle");
    Renderer renderer(device(), scene);
    drawnBy(Path::forward_plus, renderer, smallImage(GBufferEncoding::standard));
    const std::size_t before = renderer.pipelines();
    drawnBy(Path::forward_plus, renderer, smallImage(GBufferEncoding::compact));
    EXPECT_EQ(renderer.pipelines(), before + 1);
}

// Negative controls: each changes one constant in what one path draws, which the tests above must detect.
class ParityNegativeControl : public testing::Test {
protected:
    const std::vector<Frame>& sound(GBufferEncoding encoding) {
        return scene.bothPaths(smallImage(encoding));
    }
    // Pixels that differ between deferred on the original scene and forward+ on the changed one.
    std::size_t changedPixels(Channel mode) {
        Renderer renderer(device(), changed, pipelines());
        const Frame faulty = drawnBy(Path::forward_plus, renderer, smallImage(GBufferEncoding::full));
        return differingPixels(sound(GBufferEncoding::full)[0], faulty, mode);
    }
    UploadedScene& scene = uploaded("builtin:gallery");
    Scene changed = scene.scene;
};

TEST_F(ParityNegativeControl, OneLightInAThousandthIsSeen) {
    changed.lights.back().intensity *= 1.001f;
    EXPECT_GT(changedPixels(Channel::lit), 0u);
}

TEST_F(ParityNegativeControl, OneUlpOfAlbedoIsSeen) {
    for (Material& m : changed.materials) m.base_color.r = std::nextafter(m.base_color.r, 0.0f);
    EXPECT_GT(changedPixels(Channel::albedo), 0u);
}

TEST_F(ParityNegativeControl, OneUlpOfRoughnessIsSeen) {
    for (Material& m : changed.materials) m.roughness = std::nextafter(m.roughness, 0.0f);
    EXPECT_GT(changedPixels(Channel::roughness), 0u);
    EXPECT_GT(changedPixels(Channel::lit), 0u) << "and in lit";
}

TEST_F(ParityNegativeControl, APackedGBufferIsSeenByTheFullGate) {
    const Frame& full = sound(GBufferEncoding::full)[1];
    const Frame& packed = sound(GBufferEncoding::standard)[0];
    for (const Channel mode : {Channel::lit, Channel::albedo, Channel::normals, Channel::roughness,
                               Channel::lit_diffuse, Channel::lit_specular})
        EXPECT_GT(differingPixels(full, packed, mode), 0u) << debugMode(mode).name;
}

TEST_F(ParityNegativeControl, AnotherEncodingIsNotTheExplanation) {
    const Frame& compact = sound(GBufferEncoding::compact)[0];
    const Frame& standard = sound(GBufferEncoding::standard)[1];
    EXPECT_GT(differingPixels(compact.channels.at(Channel::lit), standard.through_gbuffer.at(Channel::lit)),
              0u);
}

}  // namespace
}  // namespace diptych::tests
