// SPDX-License-Identifier: MIT
// Panes and leaves in both paths: compared with closed forms, with the reference, and under settings that
// must not matter.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/textures.h"
#include "tests/image/blended.h"

#include <algorithm>
#include <cmath>

namespace diptych::tests {
namespace {

// A pane before a wall that emits (1, 2, 3), without other light towards the camera.
Scene paneOf(const glm::vec3& color, float transmission, float metallic = 0) {
    Builder b;
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 20, 0.1, 100);
    b.add("wall", quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}),
          b.material("wall", {glm::vec3(0), 0, 1, {1, 2, 3}}), glm::dvec3(0.0));
    b.add("pane", quad({-9, -9, 1}, {18, 0, 0}, {0, 18, 0}), b.material("pane", {color, metallic, 0.5f}),
          glm::dvec3(0.0));
    b.scene.materials.back().transmission = transmission;
    b.sun({0, 0, 1}, glm::vec3(1), 1);  // from behind
    return std::move(b.scene);
}

// From the front the layer reflects 0.04. The base transmits what it neither scatters nor absorbs; a metal
// absorbs all. No light reaches the pane's front, and an even wall stays even through a rough pane.
TEST(Panes, WhatPassesIsWhatTheLayerAndTheBaseLeave) {
    struct Case {
        glm::vec3 color;
        float transmission, metallic;
        double passes;  // of white
    };
    for (const Case& c :
         {Case{{1, 1, 1}, 1, 0, 0.96}, Case{{1, 1, 1}, 0.25f, 0, 0.24}, Case{{0.5f, 0.25f, 1}, 1, 0, 0.96},
          Case{{1, 1, 1}, 1, 0.5f, 0.48}, Case{{1, 1, 1}, 1, 1, 0}})
        for (const Path path : drawn_paths) {
            const glm::dvec3 made = litAt(
                drawnBlended(path, paneOf(c.color, c.transmission, c.metallic), blendedImage()), 48, 27);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(made[i], c.passes * double{c.color[i]} * (i + 1), 1e-5) << nameOf(path);
        }
}

// ---- the reference -----------------------------------------------------------------------------------

// Smooth thin walls one behind the other: whole, partly covering, masked, half metal, under a coat and a
// sheen; lit, before floor and sky. `film`: weight of a thin film on one.
Scene panes(float film = 0) {
    Builder b;
    b.camera("front", {0.6, 1.2, 5}, {0, 0.6, 0}, 40, 0.1, 100);
    b.add("floor", quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -5}),
          b.material("floor", {{0.5f, 0.48f, 0.45f}, 0, 0.6f}), glm::dvec3(0.0));
    b.add("ball", sphere(0.4, 32, 16), b.material("ball", {{0.8f, 0.3f, 0.2f}, 0, 0.4f}),
          glm::dvec3(-0.2, 0.4, -0.8));
    const auto pane = [&](const char* name, const Surface& surface, float transmission, double x, double z) {
        const int material = b.material(name, surface);
        b.scene.materials.back().transmission = transmission;
        b.add(name, quad({x, 0.2, z}, {1.2, 0, 0.15}, {0, 1.1, 0}), material, glm::dvec3(0.0));
        return &b.scene.materials.back();
    };
    pane("clear", {glm::vec3(1), 0, 0}, 1, -1.4, 0);
    pane("green", {{0.2f, 0.8f, 0.4f}, 0, 0}, 0.7f, -0.9, 0.5)->double_sided = true;
    Material* const gauze = pane("gauze", {{0.9f, 0.7f, 0.3f}, 0, 0}, 0.8f, -0.3, 0.2);
    gauze->alpha_mode = AlphaMode::blend;
    gauze->base_color.a = 0.6f;
    Material* const holes = pane("holes", {glm::vec3(1), 0, 0}, 0.9f, 0.3, 0.8);
    holes->alpha_mode = AlphaMode::mask;
    holes->base_color_texture = b.texture(lattice("lattice", 64), 1);
    pane("metal", {{0.9f, 0.7f, 0.3f}, 0.5f, 0, {0.05f, 0.1f, 0.02f}}, 0.9f, 0.5, -0.3)->ior = 1.8f;
    Material* const woven = pane("woven", {{0.6f, 0.7f, 0.9f}, 0, 0}, 0.6f, 0.9, 0.3);
    woven->clearcoat = 0.8f;
    woven->clearcoat_roughness = 0.3f;
    woven->sheen_color = {0.3f, 0.2f, 0.1f};
    woven->sheen_roughness = 0.6f;
    woven->diffuse_transmission = 0.5f;
    woven->diffuse_transmission_color = {0.2f, 0.9f, 0.4f};
    woven->iridescence = film;
    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({-0.5, 1.2, 1.6}, {1.0f, 0.7f, 0.4f}, 2, 5);
    b.point({1.2, 0.8, -0.8}, {0.4f, 0.7f, 1.0f}, 2, 5);  // behind the panes
    return std::move(b.scene);
}

TEST(Panes, AreTheReferences) {
    const Scene scene = panes();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = blendedImage();
    settings.ambient = {0.2f, 0.3f, 0.4f};
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{});
    settings.haze = true;
    settings.haze_density = 2000;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{}) << "in haze";
    settings.shadows = Shadows::pcf;  // panes cast none
    settings.reference_mode = ReferenceMode::scene;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{}) << "with shadows";
}

TEST(Panes, UnderAFilmAreTheReferences) {
    const Scene scene = panes(1);
    Renderer renderer(device(), scene, pipelines());
    EXPECT_EQ(failedChannels(scene, renderer, blendedImage()), std::vector<std::string>{});
}

// Leaves with every weight, coloured and textured, lit from both sides by suns and lamps.
Scene leaves() {
    Builder b;
    b.camera("front", {0, 0, 6}, {0, 0, 0}, 30, 0.1, 100);
    const TextureSlot veins = b.texture(checker("veins", 32, 4, {90, 255, 60, 255}, {255, 200, 90, 120}), 2);
    for (int i = 0; i < 5; ++i) {
        const float step = static_cast<float>(i);
        const int material =
            b.material("leaf", {{0.4f, 0.5f, 0.2f}, i == 4 ? 0.5f : 0.0f, 0.2f + 0.15f * step});
        Material& m = b.scene.materials.back();
        m.diffuse_transmission = 0.25f * step;
        m.diffuse_transmission_color = {0.5f, 0.9f, 0.2f};
        m.double_sided = i % 2 == 1;
        if (i == 3) m.diffuse_transmission_texture = m.diffuse_transmission_color_texture = veins;
        b.add("leaf", quad({-0.45, -1.2, 0}, {0.9, 0, 0}, {0, 2.4, 0}), material,
              at(i - 2.0, 0, 0) * rotated(20.0 * (i - 2)));
    }
    b.sun({0.3, -0.4, 1}, {1.0f, 0.9f, 0.8f}, 2);
    b.sun({-0.2, -1, -0.5}, {0.5f, 0.6f, 0.9f}, 1);
    b.point({-1, 0.5, -1}, {1.0f, 0.7f, 0.4f}, 4, 6);
    b.spot({1.5, 1, -1.5}, {0.5, 0, 0}, {0.4f, 0.7f, 1.0f}, 8, 9, {20, 40});
    return std::move(b.scene);
}

TEST(Panes, LeavesAreTheReferences) {
    const Scene scene = leaves();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = blendedImage();
    settings.ambient = {0.2f, 0.3f, 0.4f};
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{});
    settings.shadows = Shadows::pcf;
    settings.shadow_lights = 2;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{}) << "with shadows";
}

// Under radiance 1 from everywhere a white leaf is as bright as its surroundings, whatever it lets
// through.
TEST(Panes, LeavesAreInvisibleInAWhiteFurnace) {
    Scene scene = leaves();
    scene.lights.resize(1);
    scene.lights[0].intensity = 0;  // without lights, the default sun would shine
    for (Material& m : scene.materials) {
        m.base_color = {1, 1, 1, 1};
        m.diffuse_transmission_color = {1, 1, 1};
        m.diffuse_transmission_texture = m.diffuse_transmission_color_texture = {};
        m.metallic = m.specular = 0;
    }
    Settings settings = blendedImage();
    settings.ambient = {1, 1, 1};
    for (const Frame& frame :
         bothPaths(scene, settings, {Channel::lit, Channel::material_id, Channel::lit_transmission})) {
        std::size_t shown = 0;
        for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i) {
            const float id = frame.channels.at(Channel::material_id).data[i];
            if (id < 0) continue;
            ++shown;
            EXPECT_NEAR(frame.channels.at(Channel::lit).pixel(i)[1], 1, 1e-5) << frame.name;
            EXPECT_NEAR(frame.channels.at(Channel::lit_transmission).pixel(i)[1], 0.25f * id, 1e-5)
                << frame.name;
        }
        EXPECT_GT(shown, 500u);
    }
    for (Material& m : scene.materials) m.specular = 1;
    settings.multiscatter = Multiscatter::energy;
    for (const Frame& frame : bothPaths(scene, settings, {Channel::lit, Channel::material_id}))
        for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i)
            if (frame.channels.at(Channel::material_id).data[i] >= 0) {
                EXPECT_NEAR(frame.channels.at(Channel::lit).pixel(i)[1], 1, 1e-3) << frame.name << ", glossy";
            }
}

// Glass and leaves, and both at once, with every transmission, under a sheen, a coat and both, before a wall
// of radiance 1. Transmission admits by Fresnel's term of the view, and not of the lobe, and a coat is not
// compensated, so that a few percent are lost or gained.
TEST(Panes, EveryCombinationKeepsAWhiteFurnace) {
    Builder b;
    b.camera("front", {0, 0, 20}, {0, 0, 0}, 20, 0.1, 100);
    b.sun({0, 0, 1}, {1, 1, 1}, 0);  // without lights, the default sun would shine
    const int wall = b.material("wall", {glm::vec3(0), 0, 1, {1, 1, 1}});
    b.scene.materials.back().specular = 0;
    b.add("wall", quad({-30, -30, -1}, {60, 0, 0}, {0, 60, 0}), wall, glm::dvec3(0.0));
    for (int layers = 0; layers < 4; ++layers)
        for (int i = 0; i < 6; ++i) {
            const int material =
                b.material("pane", {glm::vec3(1), 0, 0.1f + 0.4f * static_cast<float>((layers + i) % 3)});
            Material& m = b.scene.materials.back();
            m.transmission = 0.5f * static_cast<float>(i % 3);
            m.diffuse_transmission = i < 3 ? 0.0f : 1.0f;
            if ((layers & 1) != 0) m.sheen_color = glm::vec3(0.5f);
            m.sheen_roughness = 0.6f;
            if ((layers & 2) != 0) m.clearcoat = 0.7f;
            m.clearcoat_roughness = 0.4f;
            b.add("pane", quad({-0.4, -0.4, 0}, {0.8, 0, 0}, {0, 0.8, 0}), material,
                  at(i - 2.5, layers - 1.5, 0));
        }
    Settings settings = with(blendedImage(), "ambient 1,1,1 multiscatter energy");
    for (const Layers way : {Layers::gbuffer, Layers::forward}) {
        settings.layers = way;
        for (const Frame& frame : bothPaths(b.scene, settings, {Channel::lit, Channel::transmission})) {
            std::size_t glass = 0;
            for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i) {
                EXPECT_NEAR(frame.channels.at(Channel::lit).pixel(i)[1], 1, 0.05) << frame.name << i;
                glass += frame.channels.at(Channel::transmission).data[i] > 0;
            }
            EXPECT_GT(glass, 400u) << frame.name;
        }
    }
}

// ---- settings ----------------------------------------------------------------------------------------

TEST(Panes, BothPathsAreEqualBitForBit) {
    const Scene scene = panes(1);
    Renderer renderer(device(), scene, pipelines());
    for (const auto& [transparency, name] : enumNames<Transparency>()) {
        Settings settings = blendedImage();
        settings.transparency = transparency;
        settings.shadows = Shadows::pcf;
        settings.haze = true;
        const std::vector<Frame> frames =
            bothPaths(renderer, settings, {Channel::lit, Channel::lit_transmission});
        expectSameChannels(frames[0], frames[1], 2);
        if (transparency == Transparency::off) continue;
        settings.transparency = Transparency::sorted;
        EXPECT_EQ(differingPixels(frames[0], drawnBy(Path::deferred, renderer, settings, {Channel::lit}),
                                  Channel::lit),
                  0u)
            << name << ": nothing is blended";
    }
}

// `--transparency off` draws neither the panes nor their channels.
TEST(Panes, AreOffWithWhatIsBlended) {
    Scene scene = paneOf({0.5f, 0.8f, 1}, 0.9f), wall = scene;
    wall.nodes.pop_back();
    Settings settings = blendedImage();
    settings.transparency = Transparency::off;
    for (const Path path : drawn_paths) {
        Renderer renderer(device(), scene, pipelines()), bare(device(), wall, pipelines());
        const Frame off = drawnBy(path, renderer, settings, {Channel::lit, Channel::transmission});
        EXPECT_EQ(differingPixels(off, drawnBy(path, bare, settings, {Channel::lit}), Channel::lit), 0u);
        for (const float v : off.channels.at(Channel::transmission).data) EXPECT_EQ(v, 0);
    }
}

// Neighbouring triangles that differ in the weight of diffuse transmission alone, in pixels that show both.
TEST(Panes, LeavesOfOtherWeightsAreNotShadedAsOne) {
    Builder b;
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 20, 0.1, 100);
    const int material = b.material("leaves", {glm::vec3(0.5f), 0, 1});
    Material& m = b.scene.materials.back();
    m.diffuse_transmission = 1;
    m.diffuse_transmission_texture =
        b.texture(checker("weights", 8, 2, {255, 255, 255, 255}, {255, 255, 255, 0}));
    Primitive all;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x) {
            Primitive cell = quad({0.27 * (x - 10), 0.27 * (y - 6), 0}, {0.27, 0, 0}, {0, 0.27, 0});
            cell.texcoords[0].assign(cell.positions.size(), {(x + y) % 2 == 0 ? 0.25f : 0.75f, 0.25f});
            append(all, cell);
        }
    b.add("leaves", all, material, glm::dvec3(0.0));
    b.sun({0, 0, 1}, glm::vec3(1), 2);  // from behind
    Renderer renderer(device(), b.scene, pipelines());
    Settings settings = with(blendedImage(), "msaa 4 msaa-edges similar");
    const std::vector<Frame> frames = bothPaths(renderer, settings, {Channel::lit});
    const Image &deferred = frames[0].channels.at(Channel::lit),
                &forward = frames[1].channels.at(Channel::lit);
    const float max = *std::ranges::max_element(forward.data);
    EXPECT_GT(max, 0.1f);
    std::size_t differing = 0, mixed = 0;
    for (std::size_t i = 0; i < forward.pixels(); ++i) {
        differing += std::abs(deferred.pixel(i)[1] - forward.pixel(i)[1]) > max / 255;
        mixed += forward.pixel(i)[1] > 0.2f * max && forward.pixel(i)[1] < 0.8f * max;
    }
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(mixed, 100u) << "no pixel shows both";
}

// Two lamps in front of a leaf under a sheen and a coat, and two behind. Lamps that reach nothing fill two
// more batches, and change no channel of light.
TEST(Panes, LayersAreTheSameInLightBatches) {
    const std::size_t max = device().profile().light_iterations;
    const auto leafUnder = [](std::size_t idle) {
        Builder b;
        b.camera("front", {0, 0, 4}, {0, 0, 0}, 30, 0.1, 100);
        const int material = b.material("leaf", {{0.4f, 0.5f, 0.2f}, 0, 0.3f});
        Material& m = b.last();
        m.clearcoat = 0.8f;
        m.clearcoat_roughness = 0.3f;
        m.sheen_color = {0.9f, 0.6f, 0.7f};
        m.sheen_roughness = 0.6f;
        m.diffuse_transmission = 0.5f;
        m.diffuse_transmission_color = {0.2f, 0.9f, 0.4f};
        b.add("leaf", quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material, glm::dvec3(0.0));
        b.point({-0.5, 0.3, 1}, {1.0f, 0.7f, 0.4f}, 2, 5);
        b.point({0.2, -0.4, -1}, {0.4f, 0.7f, 1.0f}, 2, 5);
        b.point({0.6, 0.1, 1.5}, {0.8f, 1.0f, 0.6f}, 2, 5);
        b.point({-0.3, 0.5, -0.7}, {1.0f, 0.5f, 0.9f}, 2, 5);
        for (std::size_t i = 0; i < idle; ++i) b.point({1e4, 0, 0}, {1, 1, 1}, 1, 0.1f);
        return std::move(b.scene);
    };
    const Settings settings =
        with(smallImage(GBufferEncoding::full), "size 8x4 assign every ambient 0.1,0.2,0.3");
    const std::vector<Channel> shown{
        Channel::light_count, Channel::lit,         Channel::lit_diffuse,   Channel::lit_specular,
        Channel::lit_sheen,   Channel::lit_ambient, Channel::lit_clearcoat, Channel::lit_transmission};
    const std::vector<Frame> whole = bothPaths(leafUnder(0), settings, shown),
                             parts = bothPaths(leafUnder(2 * max), settings, shown);
    for (std::size_t path = 0; path < 2; ++path)
        for (const Channel channel : shown) {
            const float brightest = *std::ranges::max_element(parts[path].channels.at(channel).data);
            if (channel == Channel::light_count) {
                EXPECT_GT(brightest, static_cast<float>(2 * max)) << "three batches";
            } else {
                EXPECT_GT(brightest, 0.01f) << debugMode(channel).name;
                EXPECT_EQ(differingPixels(whole[path], parts[path], channel), 0u)
                    << parts[path].name << " " << debugMode(channel).name;
            }
        }
}

}  // namespace
}  // namespace diptych::tests
