// SPDX-License-Identifier: MIT
// Deferred lighting by tiles (deferred/lighting_tiles.h): each tile of the image is listed once, by the
// layers that its pixels have, and the image keeps its bits.
#include "deferred/lighting_tiles.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "tests/image/scenes.h"
#include "tests/probe/kernel_frame.h"
#include "tests/support/hazards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

// Balls with coats and anisotropy on the left, below all of them and above every other one, and of the base
// on the right.
Scene halfLayered() {
    Scene scene = loadScene("builtin:layers");
    const std::size_t left = scene.materials.size() / 2;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& m = scene.materials[i];
        m.iridescence = 0;
        m.sheen_color = {};
        if (i >= left || (i < left / 2 && i % 2 == 0)) m.clearcoat = m.anisotropy = 0;
    }
    return scene;
}

Settings tiledSettings(Size size, int samples = 1) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = Path::deferred;
    settings.size = size;
    settings.msaa = samples;
    return settings;
}

// Prepared, and drawn once.
class TiledFrame {
public:
    TiledFrame(const Scene& scene, const Settings& settings)
        : shared_(device(), scene, pipelines()),
          view_(makeSceneView(scene, viewRequest(settings))),
          prepared_(device(), shared_, view_, settings) {
        prepared_.passes.run();
    }
    PassList& passes() { return prepared_.passes; }
    bool tiled() const { return prepared_.images.tiles != nullptr; }
    TileLayout layout() const { return TileLayout(prepared_.passes); }
    std::vector<gpu::uint> words() const { return contents<gpu::uint>(device(), *prepared_.images.tiles); }

private:
    SharedResources shared_;
    SceneView view_;
    PreparedFrame prepared_;
};

// Returns `count` words of a buffer from an offset in bytes.
std::vector<gpu::uint> wordsAt(const std::vector<gpu::uint>& words, VkDeviceSize offset, std::size_t count) {
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(offset / sizeof(gpu::uint));
    return {first, first + static_cast<std::ptrdiff_t>(count)};
}

// Number of pixels of each tile that are drawn, and that have a layer, in any sample of forward+.
struct TilePixels {
    std::size_t drawn = 0, layered = 0;
};
std::vector<TilePixels> pixelsOfTiles(const Scene& scene, const Settings& settings, const glm::uvec2& size) {
    Renderer renderer(device(), scene, pipelines());
    RenderOptions options;
    options.channels = {Channel::lit, Channel::material_id, Channel::clearcoat, Channel::anisotropy};
    options.every_sample = {Channel::material_id, Channel::clearcoat, Channel::anisotropy};
    options.runs = 0;
    Settings forward = settings;
    forward.path = Path::forward_plus;
    const Frame frame = renderer.draw(forward, options);
    const auto anySample = [&](Channel channel, std::size_t i, auto&& is) {
        bool any = is(frame.channels.at(channel).data[i]);
        if (const auto found = frame.further_samples.find(channel); found != frame.further_samples.end())
            for (const Image& image : found->second) any = any || is(image.data[i]);
        return any;
    };
    const auto positive = [](float value) { return value > 0; };
    std::vector<TilePixels> tiles(std::size_t{size.x} * size.y);
    for (std::size_t i = 0; i < frame.channels.at(Channel::material_id).pixels(); ++i) {
        const std::size_t x = i % static_cast<std::size_t>(settings.size.width),
                          y = i / static_cast<std::size_t>(settings.size.width);
        TilePixels& tile = tiles[y / gpu::LIGHTING_TILE * size.x + x / gpu::LIGHTING_TILE];
        tile.drawn += anySample(Channel::material_id, i, [](float id) { return id >= 0; });
        tile.layered +=
            anySample(Channel::clearcoat, i, positive) || anySample(Channel::anisotropy, i, positive);
    }
    return tiles;
}

// The class's draw, its dispatches and the listed tiles, whose order is that of the image.
void expectListed(const TileLayout& layout, const std::vector<gpu::uint>& words, gpu::uint tile_class,
                  const std::vector<gpu::uint>& expected) {
    const auto count = static_cast<gpu::uint>(expected.size());
    EXPECT_EQ(wordsAt(words, layout.draw(tile_class), 4), (std::vector<gpu::uint>{6, count, 0, 0}));
    EXPECT_EQ(wordsAt(words, layout.list(tile_class), count), expected) << "class " << tile_class;
    gpu::uint left = count;
    for (gpu::uint i = 0; i < layout.dispatches; ++i) {
        const gpu::uint tiles = std::min(left, gpu::TILES_PER_DISPATCH);
        EXPECT_EQ(wordsAt(words, layout.dispatch(tile_class) + i * sizeof(gpu::TileDispatch), 3),
                  (std::vector<gpu::uint>{16, tiles, 1}));
        left -= tiles;
    }
    EXPECT_EQ(left, 0u);
}

// Float32 stores each weight that is not 0.
void expectClassified(const Settings& settings) {
    const Scene scene = halfLayered();
    TiledFrame frame(scene, settings);
    ASSERT_TRUE(frame.tiled());
    const TileLayout layout = frame.layout();
    const std::vector<TilePixels> pixels = pixelsOfTiles(scene, settings, layout.size);
    std::vector<gpu::uint> classes;
    std::array<std::vector<gpu::uint>, gpu::TILE_CLASSES> lists;
    for (gpu::uint i = 0; i < layout.tiles; ++i) {
        classes.push_back(pixels[i].layered > 0 ? gpu::TILES_LAYERED : gpu::TILES_BASE);
        lists[classes.back()].push_back(i % layout.size.x | i / layout.size.x << 16);
    }
    const std::vector<gpu::uint> words = frame.words();
    EXPECT_EQ(wordsAt(words, layout.classes(), layout.tiles), classes);
    for (gpu::uint i = 0; i < gpu::TILE_CLASSES; ++i) expectListed(layout, words, i, lists[i]);
    frame.passes().run();
    EXPECT_EQ(frame.words(), words) << "a second frame leaves the same";
}

// The last one has more tiles than a dispatch shades, and more than threads that list them.
TEST(LightingTiles, EachIsListedOnceByItsClass) {
    for (const Size size : {Size{250, 131}, Size{33, 17}, Size{1, 1}, Size{540, 500}})
        expectClassified(tiledSettings(size));
    EXPECT_GT(17u * 16, gpu::TILES_PER_DISPATCH);
    EXPECT_GT(17u * 16, gpu::TILE_LIST_THREADS);
}

TEST(LightingTiles, OneSampleOfAPixelIsEnough) {
    expectClassified(tiledSettings({250, 131}, 4));
}

// Reads the timed frame without values that some fragments flush to 0 (lighting_test.cpp).
Image tiledLit(Renderer& renderer, const Settings& settings) {
    RenderOptions options = untimed({Channel::lit});
    options.recheck = false;
    Image image = renderer.draw(settings, options).channels.at(Channel::lit);
    for (float& value : image.data)
        if (std::abs(value) < 1e-30f) value = 0;
    return image;
}

// Both ways of lighting, against forward+, whose draws have the layers of their own material.
void expectForwardsBits(const Scene& scene, Settings settings) {
    Renderer renderer(device(), scene, pipelines());
    settings.path = Path::forward_plus;
    const Image forward = tiledLit(renderer, settings);
    EXPECT_GT(std::ranges::count_if(forward.data, [](float value) { return value > 0; }), 100);
    settings.path = Path::deferred;
    for (const Lighting lighting : {Lighting::fragment, Lighting::compute}) {
        settings.lighting = lighting;
        EXPECT_EQ(differingPixels(forward, tiledLit(renderer, settings)), 0u)
            << nameOf(lighting) << ", samples: " << settings.msaa;
    }
}

TEST(LightingTiles, KeepTheBitsOfBaseLayeredAndMixedTiles) {
    const Scene scene = halfLayered();
    for (const int samples : {1, 4}) {
        const Settings settings = tiledSettings({250, 131}, samples);
        std::size_t base = 0, layered = 0, mixed = 0;
        for (const TilePixels& tile : pixelsOfTiles(scene, settings, {8, 5})) {
            base += tile.drawn > 0 && tile.layered == 0;
            layered += tile.layered > 0 && tile.layered == tile.drawn;
            mixed += tile.layered > 0 && tile.layered < tile.drawn;
        }
        EXPECT_GT(base, 2u);
        EXPECT_GT(layered, 2u);
        EXPECT_GT(mixed, 2u);
        expectForwardsBits(scene, settings);
    }
}

// Passes that sum earlier lights are drawn by tiles too; coats hand on a sum of their own.
TEST(LightingTiles, KeepTheBitsInLightBatches) {
    Settings settings = tiledSettings({33, 17});
    settings.assign = Assignment::every;
    settings.lights = fmt::format("point:{}", device().profile().light_iterations + 7);
    expectForwardsBits(halfLayered(), settings);
}

// Only a frame whose G-buffer stores layers of some surfaces has the passes and the buffer.
TEST(LightingTiles, AreOfLayersInTheGBufferAlone) {
    const auto isTiled = [](const Scene& scene, Settings settings) {
        TiledFrame frame(scene, settings);
        const std::vector<std::string> names = frame.passes().names();
        EXPECT_EQ(std::ranges::count(names, "classify tiles"), frame.tiled() ? 1 : 0);
        return frame.tiled();
    };
    Settings settings = tiledSettings({64, 36});
    EXPECT_TRUE(isTiled(halfLayered(), settings));
    EXPECT_FALSE(isTiled(loadScene("builtin:points"), settings));
    Scene all = halfLayered();
    for (Material& m : all.materials) m.clearcoat = 1;
    EXPECT_FALSE(isTiled(all, settings)) << "no surface would be spared a layer";
    settings.layers = Layers::forward;
    EXPECT_FALSE(isTiled(halfLayered(), settings));
}

std::vector<std::string> tileHazards(const std::vector<DeclaredUse>& uses,
                                     const std::vector<RecordedBarrier>& first,
                                     const std::vector<RecordedBarrier>& again) {
    Hazards hazards;
    hazards.run(uses, first);
    hazards.run(uses, again);
    return hazards.found();
}

TEST(LightingTiles, AreReadAfterTheyAreWritten) {
    const Scene scene = halfLayered();
    for (const Lighting lighting : {Lighting::fragment, Lighting::compute}) {
        Settings settings = tiledSettings({64, 36});
        settings.lighting = lighting;
        TiledFrame frame(scene, settings);
        const std::vector<DeclaredUse> uses = frame.passes().declarations();
        const std::vector<RecordedBarrier> first = frame.passes().plannedBarriers(1);
        std::vector<RecordedBarrier> again = frame.passes().plannedBarriers(2);
        again.erase(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(first.size()));
        EXPECT_EQ(tileHazards(uses, first, again), std::vector<std::string>{}) << nameOf(lighting);
        // Negative control: one barrier of the buffer less.
        const auto isOfTiles = [](const RecordedBarrier& barrier) {
            return barrier.resource == "lighting tiles";
        };
        EXPECT_EQ(std::ranges::count_if(again, isOfTiles), 3) << "classify, list, shade";
        for (std::size_t i = 0; i < again.size(); ++i) {
            if (!isOfTiles(again[i])) continue;
            std::vector<RecordedBarrier> lacking = again;
            lacking.erase(lacking.begin() + static_cast<std::ptrdiff_t>(i));
            EXPECT_FALSE(tileHazards(uses, first, lacking).empty()) << again[i].pass;
        }
    }
}

// The two variants differ in their layers alone; the base has none.
TEST(LightingTiles, VariantsDifferInLayersAlone) {
    Variant all;
    all.set(gpu::FEATURE_layers, gpu::LAYER_CLEARCOAT | gpu::LAYER_SHEEN)
        .set(gpu::FEATURE_gbuffer_layers, gpu::LAYER_CLEARCOAT | gpu::LAYER_SHEEN)
        .set(gpu::FEATURE_point_lights);
    const auto variants = tileVariants(all);
    Variant base = variants[gpu::TILES_BASE], layered = variants[gpu::TILES_LAYERED];
    EXPECT_EQ(base.get(gpu::FEATURE_layers), 0u);
    EXPECT_EQ(base.set(gpu::FEATURE_layers, all.get(gpu::FEATURE_layers)), layered);
    EXPECT_EQ(layered.set(gpu::FEATURE_lighting_tiles, 0), all);
}

}  // namespace
}  // namespace diptych::tests
