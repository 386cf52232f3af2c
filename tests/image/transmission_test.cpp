// SPDX-License-Identifier: MIT
// Surfaces that transmit light, over either path's opaque image: compared with closed forms, the reference
// and each other.
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

// From the front the layer reflects 0.04. The base transmits what it neither scatters nor absorbs, times
// the luminance of its colour; a metal absorbs all. No light reaches the pane's front.
TEST(Transmission, WhatPassesIsWhatTheLayerAndTheBaseLeave) {
    struct Case {
        glm::vec3 color;
        float transmission, metallic;
        double passes;
    };
    const Case cases[] = {{{1, 1, 1}, 1, 0, 0.96},
                          {{1, 1, 1}, 0.25f, 0, 0.24},
                          {{0.5f, 0.25f, 1}, 1, 0, 0.96 * (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722)},
                          {{1, 1, 1}, 1, 0.5f, 0.48},
                          {{1, 1, 1}, 1, 1, 0},
                          {{3, 3, 3}, 1, 0, 1}};  // impossible in a file; nothing is amplified
    for (const Case& c : cases)
        for (const Path path : drawn_paths) {
            const glm::dvec3 made = litAt(
                drawnBlended(path, paneOf(c.color, c.transmission, c.metallic), blendedPicture()), 48, 27);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(made[i], c.passes * (i + 1), 1e-6) << c.passes << " " << nameOf(path);
        }
}

// Panes one behind the other: whole, partly covering, masked, rough, half metal; lit, before floor and
// sky.
Scene panes() {
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
    pane("clear", {glm::vec3(1), 0, 0.1f}, 1, -1.4, 0);
    pane("green", {{0.2f, 0.8f, 0.4f}, 0, 0.3f}, 0.7f, -0.9, 0.5)->double_sided = true;
    Material* const gauze = pane("gauze", {{0.9f, 0.7f, 0.3f}, 0, 0.5f}, 0.8f, -0.3, 0.2);
    gauze->alpha_mode = AlphaMode::blend;
    gauze->base_color.a = 0.6f;
    Material* const holes = pane("holes", {glm::vec3(1), 0, 0.4f}, 0.9f, 0.3, 0.8);
    holes->alpha_mode = AlphaMode::mask;
    holes->base_color_texture = b.texture(lattice("lattice", 64), 1);
    pane("metal", {{0.9f, 0.7f, 0.3f}, 0.5f, 0.3f, {0.05f, 0.1f, 0.02f}}, 0.9f, 0.5, -0.3)->ior = 1.8f;
    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({-0.5, 1.2, 1.6}, {1.0f, 0.7f, 0.4f}, 2, 5);
    return std::move(b.scene);
}

TEST(Transmission, IsTheReferences) {
    const Scene scene = panes();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = blendedPicture();
    settings.ambient = {0.2f, 0.3f, 0.4f};
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{});
    settings.haze = true;
    settings.haze_density = 2000;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{}) << "in haze";
    settings.shadows = Shadows::pcf;  // panes cast none
    settings.reference_mode = ReferenceMode::scene;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{}) << "with shadows";
}

TEST(Transmission, BothPathsAreEqualBitForBit) {
    const Scene scene = panes();
    Renderer renderer(device(), scene, pipelines());
    for (const auto& [transparency, name] : enumNames<Transparency>()) {
        Settings settings = blendedPicture();
        settings.transparency = transparency;
        settings.shadows = Shadows::pcf;
        settings.haze = true;
        const std::vector<Frame> frames = bothPaths(renderer, settings, {lit});
        EXPECT_EQ(differingPixels(frames[0].channels.at(lit), frames[1].channels.at(lit)), 0u) << name;
    }
}

// One pane at a time: order is irrelevant, and every mode must keep its transmission and reflection. Sums
// round to float32 a few more times.
TEST(Transmission, OnePaneIsTheSameInEveryMode) {
    for (const float metallic : {0.0f, 0.5f}) {
        Scene scene = paneOf({0.5f, 0.8f, 1}, 0.9f, metallic);
        scene.lights[0].direction = {0.2, -0.1, -1};
        Renderer renderer(device(), scene, pipelines());
        Settings settings = blendedPicture();
        const Image expected = drawnBy(Path::deferred, renderer, settings, {lit}).channels.at(lit);
        for (const auto& [transparency, name] : enumNames<Transparency>()) {
            if (transparency == Transparency::off) continue;
            settings.transparency = transparency;
            const Image made = drawnBy(Path::deferred, renderer, settings, {lit}).channels.at(lit);
            double most = 0;
            for (std::size_t i = 0; i < made.data.size(); ++i)
                most = std::max(most, std::abs(double{made.data[i]} / double{expected.data[i]} - 1));
            EXPECT_LT(most, 2e-5) << name << ", metallic " << metallic;
        }
    }
}

// Lists match the reference's order, also with masked or partly covering panes.
TEST(Transmission, ListsAreTheReferences) {
    const Scene scene = panes();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = blendedPicture();
    settings.transparency = Transparency::list;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{});
}

}  // namespace
}  // namespace diptych::tests
