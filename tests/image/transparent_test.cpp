// SPDX-License-Identifier: MIT
// Blended surfaces over either path's opaque image: compared with closed forms, the reference and each
// other.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/textures.h"
#include "tests/image/blended.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::tests {
namespace {

// Unlit squares with radiance `colors`, each nearer to the camera than the one before; the first is
// opaque. All fill the image.
Scene layers(const std::vector<glm::vec4>& colors) {
    Builder b;
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 20, 0.1, 100);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const int material = b.material(fmt::format("layer {}", i), {glm::vec3(colors[i]), 0, 0.5f});
        b.scene.materials.back().unlit = true;
        b.scene.materials.back().base_color.a = colors[i].a;
        if (i > 0) b.scene.materials.back().alpha_mode = AlphaMode::blend;
        b.add("layer", quad({-9, -9, 0.1 * static_cast<double>(i)}, {18, 0, 0}, {0, 18, 0}), material,
              glm::dvec3(0.0));
    }
    return std::move(b.scene);
}

std::vector<glm::vec4> someLayers(std::size_t count, float opacity) {
    std::vector<glm::vec4> colors;
    for (std::size_t i = 0; i <= count; ++i) {
        const auto x = static_cast<float>(i);
        colors.emplace_back(0.2f + std::fmod(0.37f * x, 0.8f), 0.9f - std::fmod(0.23f * x, 0.8f), 0.3f,
                            opacity);
    }
    return colors;
}

// Every layer rounds to float32 once or twice.
TEST(Transparent, LayersAreBlendedOver) {
    for (const std::size_t count : {1u, 2u, 8u, 32u})
        for (const float opacity : {0.1f, 0.5f, 1.0f}) {
            const std::vector<glm::vec4> colors = someLayers(count, opacity);
            glm::dvec3 expected(colors.front());
            for (std::size_t i = 1; i < colors.size(); ++i)
                expected = glm::mix(expected, glm::dvec3(colors[i]), double{opacity});
            for (const Path path : drawn_paths) {
                const glm::dvec3 made = litAt(drawnBlended(path, layers(colors), blendedImage()), 40, 20);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(made[c], expected[c], 2e-7 * static_cast<double>(count + 4))
                        << count << " " << opacity << " " << nameOf(path);
            }
        }
}

TEST(Transparent, WhatIsOpaqueHidesAllBehindItAndOpacity0Nothing) {
    std::vector<glm::vec4> colors = someLayers(4, 0.5f);
    colors[3].a = 1;
    const std::vector<glm::vec4> front(colors.begin() + 3, colors.end());
    std::vector<glm::vec4> more = front;
    more.insert(more.begin() + 1, glm::vec4(5, 5, 5, 0));
    for (const Path path : drawn_paths) {
        const Image whole = drawnBlended(path, layers(colors), blendedImage()).channels.at(Channel::lit);
        EXPECT_EQ(differingPixels(
                      whole, drawnBlended(path, layers(front), blendedImage()).channels.at(Channel::lit)),
                  0u);
        EXPECT_EQ(differingPixels(whole,
                                  drawnBlended(path, layers(more), blendedImage()).channels.at(Channel::lit)),
                  0u);
    }
}

TEST(Transparent, BothPathsAreEqualBitForBit) {
    for (const auto& [name, shadows] :
         {std::pair{"builtin:glass", Shadows::pcf}, {"builtin:crossed", Shadows::evsm}}) {
        Renderer& renderer = uploaded(name).renderer;
        std::optional<Image> first;
        for (const Assignment assign : {Assignment::every, Assignment::tiled, Assignment::clustered}) {
            Settings settings = blendedImage();
            settings.assign = assign;
            settings.lights = "point:200,spot:56";
            settings.light_cutoff = 0;
            const std::vector<Frame> frames = bothPaths(renderer, settings, {Channel::lit});
            EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u)
                << name << " " << nameOf(assign);
            if (!first) first = frames[0].channels.at(Channel::lit);
            EXPECT_EQ(differingPixels(*first, frames[0].channels.at(Channel::lit)), 0u)
                << name << " " << nameOf(assign) << " leaves out a light";
        }
        Settings settings = with(blendedImage(), "haze on haze-density 2000 transparency unsorted");
        settings.ambient = {0.2f, 0.3f, 0.4f};
        settings.shadows = shadows;
        const std::vector<Frame> frames = bothPaths(renderer, settings, {Channel::lit});
        EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u) << name << " " << nameOf(shadows);
    }
}

// The G-buffer's channels show the opaque surfaces.
TEST(Transparent, OtherChannelsAreThoseOfTheOpaqueSurfaces) {
    Scene scene = loadScene("builtin:glass"), opaque = scene;
    for (Mesh& mesh : opaque.meshes)
        std::erase_if(mesh.primitives, [&](const Primitive& p) {
            return opaque.materials[static_cast<std::size_t>(p.material)].alpha_mode == AlphaMode::blend;
        });
    const std::vector<Channel> channels{Channel::lit, Channel::albedo, Channel::depth, Channel::lit_diffuse};
    for (const Path path : drawn_paths) {
        Renderer renderer(device(), scene, pipelines()), without(device(), opaque, pipelines());
        const Frame all = drawnBy(path, renderer, blendedImage(), channels),
                    rest = drawnBy(path, without, blendedImage(), channels);
        const auto max = [&](Channel mode) {
            const DebugMode& m = debugMode(mode);
            const Image &a = rest.channels.at(mode), &b = all.channels.at(mode);
            return channelStats(m.error_kind, m.kind, a, b, everyPixel(a.pixels())).max;
        };
        EXPECT_GT(max(Channel::lit), 0.1) << nameOf(path);
        EXPECT_EQ(max(channels[1]), 0) << nameOf(path);
        EXPECT_EQ(max(channels[2]), 0) << nameOf(path);
        // F0 is then read, not a constant: some blended materials are unlit.
        EXPECT_LT(max(channels[3]), 1e-6) << nameOf(path);
    }
}

// For every mode: no pass, no memory and no constant of blending without blended surfaces.
TEST(Transparent, WithoutBlendingEveryModeIsTheSameFrame) {
    RenderOptions options;
    options.channels = {Channel::lit};
    options.runs = 1;
    for (const Path path : drawn_paths) {
        std::optional<Frame> first;
        for (const auto& [transparency, name] : enumNames<Transparency>()) {
            Settings settings = blendedImage();
            settings.path = path;
            settings.transparency = transparency;
            Frame frame = uploaded("builtin:cutout").renderer.draw(settings, options);
            if (!first)
                first = std::move(frame);
            else {
                EXPECT_EQ(frame.bytes.images, first->bytes.images) << name;
                EXPECT_EQ(frame.bytes.buffers, first->bytes.buffers) << name;
                EXPECT_EQ(frame.passes.size(), first->passes.size()) << name;
                EXPECT_EQ(differingPixels(frame.channels.at(Channel::lit), first->channels.at(Channel::lit)),
                          0u)
                    << name;
            }
        }
    }
}

TEST(Transparent, WithoutBlendingThereIsNoPass) {
    for (const auto& [name, blends] : {std::pair("builtin:glass", true), {"builtin:cutout", false}}) {
        RenderOptions options;
        options.channels = {Channel::lit};
        options.runs = 1;
        Settings settings = blendedImage();
        settings.path = Path::deferred;
        const Frame frame = uploaded(name).renderer.draw(settings, options);
        EXPECT_EQ(std::ranges::count(frame.passes, std::string("transparent"), &PassTime::name),
                  blends ? 1 : 0)
            << name;
    }
}

TEST(Transparent, SortedIsTheReferencesOrder) {
    Settings settings = blendedImage();
    EXPECT_EQ(failedChannels("builtin:glass", settings), std::vector<std::string>{});
    settings.camera = "inside";
    EXPECT_EQ(failedChannels("builtin:glass", settings), std::vector<std::string>{})
        << "from inside of a ball";
    settings.camera = Settings().camera;
    settings.haze = true;
    settings.haze_density = 2000;
    EXPECT_EQ(failedChannels("builtin:glass", settings), std::vector<std::string>{}) << "in haze";
}

TEST(Transparent, AnotherOrderFails) {
    Settings settings = blendedImage();
    settings.transparency = Transparency::unsorted;
    const std::vector<std::string> failed = failedChannels("builtin:crossed", settings);
    ASSERT_EQ(failed.size(), 2u);
    for (const std::string& each : failed) EXPECT_EQ(each.substr(0, 4), "lit:");
}

// Two rows of panes, one draw each, interleaved in depth: their centres do not give the order. In both the
// nearer panes come first.
Scene interleavedRows() {
    Builder b;
    b.camera("front", {0.6, 0.9, 6}, {0, 0, 0}, 30, 0.1, 100);
    b.add("floor", quad({-3, -1.2, 2}, {6, 0, 0}, {0, 0, -5}),
          b.material("floor", {{0.5f, 0.48f, 0.45f}, 0, 0.6f}), glm::dvec3(0.0));
    for (const int row : {0, 1}) {
        const int material =
            b.material(row == 0 ? "red" : "blue",
                       {row == 0 ? glm::vec3(0.8f, 0.1f, 0.1f) : glm::vec3(0.1f, 0.2f, 0.8f), 0, 0.5f});
        b.scene.materials.back().alpha_mode = AlphaMode::blend;
        b.scene.materials.back().base_color.a = 0.5f;
        b.scene.materials.back().double_sided = row == 0;
        Primitive all;
        for (int pane = 0; pane < 4; ++pane) {
            const Primitive one =
                quad({-0.9 + 0.1 * row, -0.8, 1 - 0.5 * pane - 0.25 * row}, {1.6, 0, 0}, {0, 1.5, 0});
            const auto first = static_cast<std::uint32_t>(all.positions.size());
            for (const std::uint32_t i : one.indices) all.indices.push_back(first + i);
            const auto append = [](auto& to, const auto& from) {
                to.insert(to.end(), from.begin(), from.end());
            };
            append(all.positions, one.positions);
            append(all.normals, one.normals);
            append(all.tangents, one.tangents);
            append(all.texcoords[0], one.texcoords[0]);
        }
        b.add("row", all, material, glm::dvec3(0.0));
    }
    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({-0.5, 1.4, 2.2}, {1.0f, 0.7f, 0.4f}, 2, 6);
    return std::move(b.scene);
}

TEST(Transparent, TrianglesAreTheReferencesOrderWhereThoseOfDrawsAreNot) {
    const Scene scene = interleavedRows();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = blendedImage();
    EXPECT_EQ(failedChannels(scene, renderer, settings).size(), 2u) << "sorted";
    settings.transparency = Transparency::triangles;
    EXPECT_EQ(failedChannels(scene, renderer, settings), std::vector<std::string>{});
    const std::vector<Frame> frames = bothPaths(renderer, settings, {Channel::lit});
    EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u);
    // Another order of the same draws: their light lists stay the same.
    Settings every = settings, object = settings;
    every.assign = Assignment::every;
    object.assign = Assignment::per_object;
    for (const Path path : drawn_paths)
        EXPECT_EQ(differingPixels(drawnBy(path, renderer, every, {Channel::lit}),
                                  drawnBy(path, renderer, settings, {Channel::lit}), Channel::lit),
                  0u)
            << nameOf(path);
    EXPECT_EQ(differingPixels(drawnBy(Path::forward_plus, renderer, every, {Channel::lit}),
                              drawnBy(Path::forward_plus, renderer, object, {Channel::lit}), Channel::lit),
              0u);
}

// Balls seen from outside and inside, 32 layers in a row, a draw's back faces before its front faces.
TEST(Transparent, TrianglesAreRightWhereDrawsAre) {
    Settings settings = blendedImage();
    settings.transparency = Transparency::triangles;
    EXPECT_EQ(failedChannels("builtin:glass", settings), std::vector<std::string>{});
    settings.camera = "inside";
    EXPECT_EQ(failedChannels("builtin:glass", settings), std::vector<std::string>{})
        << "from inside of a ball";
    // Intersecting panes.
    settings.camera = Settings().camera;
    EXPECT_EQ(failedChannels("builtin:crossed", settings).size(), 2u);
}

// Sets the alpha mode and opacity of every material without a mask; alpha of textures and vertices becomes
// 1.
Scene allOf(AlphaMode mode, float opacity, Scene scene) {
    for (Material& material : scene.materials) {
        if (material.alpha_mode == AlphaMode::mask) continue;
        material.alpha_mode = mode;
        material.base_color.a = opacity;
    }
    for (TextureImage& image : scene.images)
        for (std::size_t i = 3; i < 4 * static_cast<std::size_t>(image.width) * image.height; i += 4) {
            if (!image.rgba.empty()) image.rgba[i] = 0xff;
            if (!image.rgba16.empty()) image.rgba16[i] = 0xffff;
            if (!image.rgba32.empty()) image.rgba32[i] = 1;
        }
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            for (glm::vec4& color : primitive.colors) color.a = 1;
    return scene;
}

class BlendedScene : public testing::TestWithParam<std::string> {};

// Textures and their transforms, both UV sets, vertex colours, lightmaps, emission, unlit materials, every
// type of light. Blended with opacity 1, a surface equals its opaque version within 2e-7. Blended surfaces
// cast no shadow.
TEST_P(BlendedScene, OfOpacity1IsTheOpaqueOne) {
    const Scene scene = loadScene(GetParam());
    Settings settings = with(
        blendedImage(), "path forward_plus shadows off transparency list transparency-layers 32 haze on");
    const Image opaque = drawnBlended(Path::forward_plus, allOf(AlphaMode::opaque, 1, scene), settings)
                             .channels.at(Channel::lit);
    EXPECT_GT(*std::ranges::max_element(opaque.data), 0.0f);
    for (const Path path : drawn_paths) {
        const Image made =
            drawnBlended(path, allOf(AlphaMode::blend, 1, scene), settings).channels.at(Channel::lit);
        double max = 0;
        for (std::size_t i = 0; i < made.data.size(); ++i)
            max = std::max(max, std::abs(double{made.data[i]} - double{opaque.data[i]}) /
                                    std::max(1.0, double{opaque.data[i]}));
        EXPECT_LE(max, 2e-7) << nameOf(path);
    }
}

// Opacity 1/2 with all surfaces overlapping: equal in both paths, and finite everywhere.
TEST(Transparent, WhereEverythingBlendsBothPathsAreAlikeInEveryMode) {
    for (const char* each : {"builtin:vertex_colors", "builtin:lightmaps"}) {
        const Scene scene = allOf(AlphaMode::blend, 0.5f, loadScene(each));
        Renderer renderer(device(), scene, pipelines());
        for (const auto& [transparency, name] : enumNames<Transparency>()) {
            Settings settings = blendedImage();
            settings.transparency = transparency;
            const std::vector<Frame> frames = bothPaths(renderer, settings, {Channel::lit});
            EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u) << each << " " << name;
            EXPECT_EQ(frames[0].counters.nonfinite_pixels, 0u) << each << " " << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, BlendedScene,
                         testing::Values("builtin:vertex_colors", "builtin:unlit_materials",
                                         "builtin:lightmaps", "builtin:sixteen_bits", "builtin:dielectrics",
                                         "builtin:emission", "builtin:mirrored", "builtin:ortho",
                                         "builtin:areas", "builtin:deep"),
                         sceneName);

// A blended surface is attenuated by the air in front of it, not by that up to the surface behind. Level
// rays without sun or other light in the air: e^(-extinction distance) of each surface is the whole
// effect.
TEST(Transparent, HazeIsThatOfItsOwnDepth) {
    constexpr double near = 100, far = 400;
    Builder b;
    b.camera("front", {0, 0, 0}, {0, 0, -1}, 20, 0.1, 1e4);
    const auto wall = [&](double distance, const glm::vec3& color, float opacity) {
        const int material = b.material("wall", {color, 0, 0.5f});
        b.scene.materials.back().unlit = true;
        b.scene.materials.back().base_color.a = opacity;
        if (opacity < 1) b.scene.materials.back().alpha_mode = AlphaMode::blend;
        b.add("wall", quad({-500, -500, -distance}, {1000, 0, 0}, {0, 1000, 0}), material, glm::dvec3(0.0));
    };
    const glm::dvec3 front(0.25, 0.5, 0.75), behind(1, 0.75, 0.5);
    wall(far, behind, 1);
    wall(near, front, 0.5f);
    const Scene& scene = b.scene;
    for (const int steps : {0, 32})
        for (const auto& [transparency, name] : enumNames<Transparency>()) {
            Settings settings = blendedImage();
            settings.size = {97, 55};  // its middle pixel looks straight ahead
            settings.transparency = transparency;
            settings.haze = true;
            settings.haze_density = 100;
            settings.haze_march_steps = steps;
            const glm::dvec3 extinction =
                100.0 * (glm::dvec3(5.8e-6, 13.5e-6, 33.1e-6) + glm::dvec3(2e-5 / 0.9));
            const glm::dvec3 seen = behind * glm::exp(-extinction * far),
                             hazed = front * glm::exp(-extinction * near);
            const glm::dvec3 expected = transparency == Transparency::off ? seen : 0.5 * hazed + 0.5 * seen;
            for (const Path path : drawn_paths) {
                const glm::dvec3 made = litAt(drawnBlended(path, scene, settings), 48, 27);
                // Ray marching sums the optical depths of two media in float32.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(made[c], expected[c], steps > 0 ? 1e-5 : 2e-6)
                        << name << " " << nameOf(path) << " " << steps;
            }
        }
}

// The near plane clips a pane that leans towards the camera: the sky is visible where it is clipped.
TEST(Transparent, TheNearPlaneCutsWhatIsBlended) {
    for (const Transparency transparency :
         {Transparency::sorted, Transparency::list, Transparency::moments}) {
        Builder b;
        b.camera("front", {0, 0, 0}, {0, 0, -10}, 60, 1, 100);
        const int material = b.material("pane", {glm::vec3(0.25f, 0.5f, 1), 0, 0.5f});
        b.scene.materials.back().unlit = true;
        b.scene.materials.back().alpha_mode = AlphaMode::blend;
        b.scene.materials.back().base_color.a = 0.5f;
        b.scene.materials.back().double_sided = true;
        // From 4 m in front of the camera, below the horizon, to behind it.
        b.add("pane", quad({-20, -2, -4}, {40, 0, 0}, {0, 3, 4.5}), material, glm::dvec3(0.0));
        b.scene.environment = {"sky", Image(8, 4, 3, 2.0f)};
        Settings settings = blendedImage();
        settings.transparency = transparency;
        for (const Path path : drawn_paths) {
            const Frame frame = drawnBlended(path, b.scene, settings);
            EXPECT_EQ(frame.counters.nonfinite_pixels, 0u);
            // 1 m in front of the camera it is at the horizon's height, -2 + 3 (3 / 4.5) = 0.
            const glm::dvec3 below = litAt(frame, 48, 40), above = litAt(frame, 48, 2);
            EXPECT_NEAR(below.x, 0.5 * 0.25 + 0.5 * 2, 1e-5) << nameOf(transparency) << " " << nameOf(path);
            EXPECT_NEAR(above.x, 2, 1e-5) << nameOf(transparency) << " " << nameOf(path);
        }
    }
}

}  // namespace
}  // namespace diptych::tests
