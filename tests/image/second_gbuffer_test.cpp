// SPDX-License-Identifier: MIT
// Layers that a second pass of the G-buffer draws, because one pass has too few attachments.
#include "compare/render/path_plan.h"
#include "shared/material/gbuffer_layout.h"
#include "tests/image/square.h"

#include <algorithm>
#include <array>

namespace diptych::tests {
namespace {

// All layers; with --gbuffer full five of ten attachments.
void addEveryLayer(Material& m) {
    m.metallic = 0;
    m.roughness = 0.4f;
    m.specular = 0.6f;
    m.clearcoat = 0.7f;
    m.clearcoat_roughness = 0.3f;
    m.anisotropy = 0.5f;
    m.sheen_color = {0.4f, 0.2f, 0.6f};
    m.sheen_roughness = 0.5f;
    m.iridescence = 0.6f;
    m.diffuse_transmission = 0.4f;
    m.diffuse_transmission_color = {0.9f, 0.5f, 0.2f};
}

bool hasSecondPass(const Scene& scene, const Settings& settings) {
    return !gbufferPasses(gbufferLayout(settings.gbuffer, requirements(scene, poseAt(scene, settings.time)),
                                        settings.msaa > 1))
                .second.empty();
}

// Draws both paths, which must have the same bits, and returns the deferred path's frame.
Frame expectOneImage(Renderer& renderer, const Settings& settings) {
    std::vector<Channel> channels{Channel::lit, Channel::material_id, albedo, normals,
                                  Channel::diffuse_transmission};
    for (const DebugMode& mode : debugModes())
        if (layerOf(mode.channel) != 0 && mode.channel >= Channel::clearcoat &&
            mode.channel < Channel::transmission)
            channels.push_back(mode.channel);
    std::vector<Frame> frames = bothPaths(renderer, settings, channels);
    expectSameChannels(frames[0], frames[1], 10);
    EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u) << settings.msaa;
    return std::move(frames[0]);
}

std::size_t pixelsAbove0(const Image& image) {
    return static_cast<std::size_t>(std::ranges::count_if(image.data, [](float x) { return x > 0; }));
}

TEST(SecondGBuffer, SkinnedMorphedAndMaskedSurfacesAreBitEqual) {
    Scene scene = loadScene("builtin:motion");
    for (Material& m : scene.materials)
        if (m.name == "clay" || m.name == "ball" || m.name == "leaf") addEveryLayer(m);
    Renderer renderer(device(), scene, pipelines());
    for (const int samples : {1, 4}) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.time = 0.6;
        settings.msaa = samples;
        settings.alpha_to_coverage = samples > 1;
        ASSERT_TRUE(hasSecondPass(scene, settings));
        const Frame frame = expectOneImage(renderer, settings);
        EXPECT_GT(pixelsAbove0(frame.channels.at(Channel::diffuse_transmission)), 200u);
        EXPECT_GT(coveredPixels(frame),
                  pixelsAbove0(frame.channels.at(Channel::diffuse_transmission)) + 1000);
    }
}

// Two squares at one place, one with layers and one without: the one drawn last is stored in all
// attachments. Draws are sorted by variant, so a double-sided square without layers comes last.
TEST(SecondGBuffer, OfTwoSurfacesAtOneDepthTheLastIsStored) {
    for (const bool plain_last : {false, true})
        for (const int samples : {1, 4}) {
            Scene scene = square();
            scene.nodes.push_back(scene.nodes[0]);
            scene.nodes[1].mesh = 1;
            scene.meshes.push_back(scene.meshes[0]);
            scene.materials.push_back({});
            scene.meshes[1].primitives[0].material = 1;
            addEveryLayer(scene.materials[0]);
            scene.materials[1].double_sided = plain_last;
            scene.lights = {sunAlong(glm::normalize(glm::dvec3(-0.3, -0.2, -1)))};
            Settings settings = smallImage(GBufferEncoding::full);
            settings.size = {8, 8};
            settings.msaa = samples;
            ASSERT_TRUE(hasSecondPass(scene, settings));
            Renderer renderer(device(), scene, pipelines());
            const Frame frame = expectOneImage(renderer, settings);
            EXPECT_EQ(pixelsAbove0(frame.channels.at(Channel::diffuse_transmission)), plain_last ? 0u : 64u);
        }
}

// Packed layers fill two attachments; the other seven leave room for one of them.
TEST(SecondGBuffer, PackedLayersAreStored) {
    Scene scene = square();
    Material& m = scene.materials[0];
    addEveryLayer(m);
    m.emissive = {1, 1, 1};
    m.lightmap_texture.texture = 0;
    for (const GBufferEncoding encoding : {GBufferEncoding::standard, GBufferEncoding::compact}) {
        Settings settings = with(smallImage(encoding), "size 4x4 msaa 4");
        ASSERT_TRUE(hasSecondPass(scene, settings));
        Renderer renderer(device(), scene, pipelines());
        const Frame frame =
            drawnBy(Path::deferred, renderer, settings,
                    {Channel::iridescence, Channel::sheen_roughness, Channel::diffuse_transmission});
        constexpr float half_step = 0.5f / 255 + float32;
        for (const auto& [mode, value] : {std::pair(Channel::iridescence, 0.6f),
                                          {Channel::sheen_roughness, 0.5f},
                                          {Channel::diffuse_transmission, 0.4f}})
            EXPECT_NEAR(frame.channels.at(mode).at(1, 2, 0), value, half_step) << debugMode(mode).name;
    }
}

TEST(SecondGBuffer, ThePlanNamesIt) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = Path::deferred;
    const auto planned = [&](const Scene& scene) {
        SceneViews views(scene);
        return planPaths(device(), views, {settings}).front();
    };
    Scene scene = square();
    constexpr std::array names{"G-buffer", "G-buffer of layers"};
    const std::string note =
        "a second G-buffer pass draws 2 of 10 attachments, 32 bytes per pixel: a pass has at most 8";
    const PathPlan one = planned(scene);
    EXPECT_EQ(std::ranges::count(one.passes, names[0]), 1);
    EXPECT_EQ(std::ranges::count(one.passes, names[1]), 0);
    addEveryLayer(scene.materials[0]);
    const PathPlan two = planned(scene);
    EXPECT_NE(std::ranges::search(two.passes, names).begin(), two.passes.end());
    EXPECT_EQ(std::ranges::count(two.notes, note), 1);
    // Specular colour, and five attachments of layers; three words take four.
    EXPECT_EQ(two.bytes.front().geometry, one.bytes.front().geometry + 6 * 16);
}

}  // namespace
}  // namespace diptych::tests
