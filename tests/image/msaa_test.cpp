// SPDX-License-Identifier: MIT
// MSAA: deferred lighting matches forward+ for any sample grouping, and both resolve alike.
#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"
#include "tests/image/square.h"
#include "tests/support/campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

Settings sampled(Size size, MsaaShading shading = MsaaShading::pixel) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    settings.msaa = 4;
    settings.msaa_shading = shading;
    return settings;
}

Frame litOf(Renderer& renderer, Settings settings, Path path) {
    return drawnBy(path, renderer, std::move(settings), {Channel::lit});
}

// Compares forward+ with deferred that shades every sample, and with deferred that shades each surface
// once.
void expectTheSame(Renderer& renderer, const Settings& settings, const std::string& what) {
    const Frame forward = litOf(renderer, settings, Path::forward_plus);
    EXPECT_EQ(forward.counters.unreproduced_pixels, 0u) << what;
    for (const MsaaEdges edges : {MsaaEdges::exact, MsaaEdges::all}) {
        Settings other = settings;
        other.msaa_edges = edges;
        const Frame deferred = litOf(renderer, other, Path::deferred);
        EXPECT_EQ(differingPixels(forward, deferred, Channel::lit), 0u) << what << " " << nameOf(edges);
        EXPECT_EQ(deferred.counters.unreproduced_pixels, 0u) << what << " " << nameOf(edges);
    }
}

constexpr std::array shadings{MsaaShading::pixel, MsaaShading::sample};

class MsaaBuiltin : public SceneTest {};

TEST_P(MsaaBuiltin, BothPathsAreBitEqual) {
    UploadedScene& scene = uploaded(GetParam());
    for (const MsaaShading shading : shadings)
        expectTheSame(scene.renderer, sampled({96, 54}, shading), std::string(nameOf(shading)));
}

INSTANTIATE_TEST_SUITE_P(Msaa, MsaaBuiltin,
                         testing::Values("builtin:gallery", "builtin:emission", "builtin:sixteen_bits",
                                         "builtin:glass", "builtin:cutout", "builtin:lightmaps",
                                         "builtin:areas", "builtin:motion", "builtin:ortho",
                                         "builtin:many_materials"),
                         sceneName);

Environment unevenSky() {
    Environment sky{"uneven", Image(16, 8, 3)};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 3; ++c)
                sky.radiance.at(x, y, c) = 0.2f + 0.1f * static_cast<float>((x * (c + 1) + 3 * y) % 7);
    return sky;
}

// Real scenes with every feature of both paths, at a time after animated parts have moved: under a
// non-uniform sky, in haze, with shadows of the sun and of lamps. A campaign renders all of them.
std::vector<std::string> sampledAssets() {
    if (isCampaign()) return assetScenes();
    return {"flight_helmet/FlightHelmet.gltf", "features/alpha_mask/01_alpha_mask.gltf",
            "features/glass_table/glass_table.glb"};
}
class MsaaAsset : public SceneTest {};

TEST_P(MsaaAsset, BothPathsAreBitEqual) {
    Scene scene = loadScene(name());
    scene.environment = unevenSky();
    Settings settings = with(sampled({64, 36}),
                             "lights point:12,spot:4 env scene ibl-samples 32 shadows pcf shadow-lights 2 "
                             "haze on haze-density 100 time 0.4");
    Renderer renderer(device(), scene, pipelines());
    for (const MsaaShading shading : shadings) {
        settings.msaa_shading = shading;
        expectTheSame(renderer, settings, GetParam() + " " + std::string(nameOf(shading)));
    }
}

INSTANTIATE_TEST_SUITE_P(Msaa, MsaaAsset, testing::ValuesIn(sampledAssets()), sceneName);

// Every channel is that of the first sample, in both paths.
TEST(Msaa, EveryChannelIsTheSameInBothPaths) {
    // Shading every sample compiles the gallery's many materials again.
    for (const auto& [shading, scene] :
         {std::pair{MsaaShading::pixel, "builtin:gallery"}, {MsaaShading::sample, "builtin:cutout"}}) {
        const std::vector<Frame> frames = bothPaths(uploaded(scene).renderer, sampled({96, 54}, shading));
        expectSameChannels(frames[0], frames[1]);
        for (const Frame& frame : frames) EXPECT_EQ(frame.counters.nonfinite_pixels, 0u);
    }
}

TEST(Msaa, WithShadowsHazeAndAnEnvironment) {
    Settings settings =
        with(sampled({64, 36}),
             "shadows pcf shadow-lights 2 lights point:3,spot:2 haze on haze-density 50 ambient 0.1,0.2,0.3");
    Renderer& renderer = uploaded("builtin:cutout").renderer;
    for (const MsaaShading shading : shadings) {
        settings.msaa_shading = shading;
        expectTheSame(renderer, settings, std::string(nameOf(shading)));
    }
    for (const Shadows technique : {Shadows::evsm, Shadows::clipmap}) {
        settings.shadows = technique;
        settings.shadow_fit = technique == Shadows::evsm ? ShadowFit::depth : ShadowFit::view;
        expectTheSame(renderer, settings, std::string(nameOf(technique)));
    }
}

// No light is lost. A partly hidden triangle may be shaded at a point farther away than anything visible
// in its tile. Slanted, thin triangles in front of each other make many such pixels.
TEST(Msaa, ListsHoldEveryLightOfAPixel) {
    Scene scene = square();
    const Primitive leaf = scene.meshes[0].primitives[0];
    scene.nodes.clear();
    for (int i = 0; i < 60; ++i) {
        const double turn = 83.0 * i;
        const glm::dmat4 at =
            glm::translate(glm::dmat4(1.0), glm::dvec3(std::sin(1.7 * i), std::cos(2.3 * i), -0.35 * i - 1));
        scene.nodes.push_back({"leaf", -1,
                               glm::rotate(glm::rotate(at, glm::radians(turn), glm::dvec3(1, 0.3, 0)), turn,
                                           glm::dvec3(0, 0, 1)) *
                                   glm::scale(glm::dmat4(1.0), glm::dvec3(0.6, 0.08, 1)),
                               0});
    }
    scene.materials[0].double_sided = true;
    scene.cameras[0].far = 100;
    Renderer renderer(device(), scene, pipelines());
    for (const MsaaShading shading : shadings) {
        Settings settings = with(sampled({64, 64}, shading), "lights point:200,spot:50 assign every");
        const Frame every = litOf(renderer, settings, Path::forward_plus);
        for (const Assignment assign : {Assignment::tiled, Assignment::clustered})
            for (const Path path : drawn_paths) {
                settings.assign = assign;
                settings.prepass = Switch::on;
                const Frame listed = litOf(renderer, settings, path);
                EXPECT_EQ(differingPixels(every, listed, Channel::lit), 0u)
                    << nameOf(assign) << " " << nameOf(path) << " " << nameOf(shading);
            }
    }
}

// A square 1 m away covers all samples of every pixel. Channels show the first sample, which is shaded at the
// mean location of its triangle's samples, or at its own.
TEST(Msaa, SamplesAreShadedAtTheirMeanOrEach) {
    const Scene scene = square();
    Renderer renderer(device(), scene, pipelines());
    for (const auto& [shading, place] :
         {std::pair{MsaaShading::pixel, glm::vec2(0.5f)}, {MsaaShading::sample, glm::vec2(0.375f, 0.125f)}})
        for (const Frame& frame : bothPaths(renderer, sampled({4, 4}, shading), {Channel::position}))
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) {
                    if (x + y == 3) continue;  // both triangles cover it
                    const glm::vec2 at = (glm::vec2(x, y) + place) / 2.0f;
                    expectColor(colorAt(frame, Channel::position, x, y), {at.x - 1, 1 - at.y, -1}, 1e-5f,
                                fmt::format("{} {} {},{}", frame.name, nameOf(shading), x, y));
                }
}

// A speck before the square covers one sample. Its depth, 0.5 m, is the least that shadows are fitted to.
TEST(Msaa, ShadowsAreFittedToEverySample) {
    Settings settings = with(sampled({4, 4}), "shadows pcf shadow-fit depth");
    for (const glm::vec2 sample :
         {glm::vec2(0.375f, 0.125f), {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}}) {
        Scene scene = square();
        scene.lights = {sunAlong({0, 0, -1})};
        const glm::vec2 at = (glm::vec2(2, 1) + sample) / 4.0f;
        scene.meshes[0].primitives.push_back(
            rectangle({at.x - 0.51f, 0.49f - at.y, 0.5f}, {0.02f, 0, 0}, {0, 0.02f, 0}));
        Renderer renderer(device(), scene, pipelines());
        const std::vector<std::string> notes = litOf(renderer, settings, Path::deferred).notes;
        EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
            return note.find("visible depths, 0.5 to 1 m") != std::string::npos;
        })) << fmt::format("{}", fmt::join(notes, "\n"));
    }
}

TEST(Msaa, ImagesOfAnySize) {
    for (const Size size : {Size{1, 1}, Size{33, 17}, Size{4097, 3}})
        expectTheSame(uploaded("builtin:cutout").renderer, sampled(size), "");
}

// A packed G-buffer differs only by its encoding, as without MSAA.
TEST(Msaa, PackedDiffersByItsEncodingAlone) {
    for (const GBufferEncoding encoding : {GBufferEncoding::standard, GBufferEncoding::compact}) {
        Settings settings = sampled({96, 54});
        settings.gbuffer = encoding;
        const std::vector<Frame> frames =
            bothPaths(uploaded("builtin:gallery").renderer, settings, {Channel::lit});
        EXPECT_EQ(
            differingPixels(frames[0].channels.at(Channel::lit), frames[1].through_gbuffer.at(Channel::lit)),
            0u)
            << nameOf(encoding);
    }
}

// A triangle of constant radiance, without lights, on a black background: k of 4 samples of each pixel are
// covered.
TEST(Msaa, ResolvesAsItSays) {
    Scene scene = square();
    scene.meshes[0].primitives[0].indices = {0, 1, 2};
    // Its long edge crosses one to four samples of a pixel.
    scene.nodes[0].parent_from_node = glm::rotate(glm::dmat4(1.0), glm::radians(17.0), glm::dvec3(0, 0, 1));
    constexpr glm::vec3 light(0.75, 0.5, 0.125);
    scene.materials[0].unlit = true;
    scene.materials[0].base_color = glm::vec4(light, 1);
    Renderer renderer(device(), scene, pipelines());
    for (const Resolve resolve : {Resolve::linear, Resolve::tonemapped}) {
        Settings settings = sampled({31, 17});
        settings.resolve = resolve;
        std::array<int, 5> seen{};
        for (const Path path : drawn_paths) {
            const Frame frame = litOf(renderer, settings, path);
            const Image& image = frame.channels.at(Channel::lit);
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) {
                    bool known = false;
                    for (int k = 0; k <= 4; ++k) {
                        const double weight = resolve == Resolve::linear ? 1 : 1 / (1.0 + double{light.x}),
                                     fraction = k * weight / (k * weight + 4 - k);
                        bool same = true;
                        for (int c = 0; c < 3; ++c)
                            same = same && std::abs(double{image.at(x, y, c)} - fraction * double{light[c]}) <
                                               1e-6 * double{light[c]};
                        known |= same;
                        seen.at(static_cast<std::size_t>(k)) += same;
                    }
                    EXPECT_TRUE(known) << x << "," << y << " " << image.at(x, y, 0) << " " << nameOf(resolve);
                }
        }
        for (int k = 0; k <= 4; ++k) EXPECT_GT(seen.at(static_cast<std::size_t>(k)), 0) << k;
    }
}

TEST(Msaa, CoverageMissesWhatInterpenetrates) {
    const Scene scene = crossingSquares();
    Renderer renderer(device(), scene, pipelines());
    const Frame forward = litOf(renderer, sampled({32, 32}), Path::forward_plus);
    const Image& truth = forward.channels.at(Channel::lit);
    const float max = *std::max_element(truth.data.begin(), truth.data.end());
    // By more than 1/255 of the maximum. The two triangles of a square are similar: shaded as one, they
    // differ by the distance of the two shading points.
    const auto differing = [&](MsaaEdges edges) {
        Settings settings = sampled({32, 32});
        settings.msaa_edges = edges;
        const Frame frame = litOf(renderer, settings, Path::deferred);
        const Image& image = frame.channels.at(Channel::lit);
        int count = 0;
        for (std::size_t i = 0; i < truth.data.size(); ++i)
            count += std::abs(image.data[i] - truth.data[i]) > max / 255;
        return count;
    };
    EXPECT_EQ(differing(MsaaEdges::exact), 0);
    EXPECT_EQ(differing(MsaaEdges::similar), 0) << "they are of two materials";
    EXPECT_GT(differing(MsaaEdges::coverage), 5);
}

TEST(Msaa, WhatIsNotDrawnWithSeveralSamplesIsNamed) {
    Settings settings = sampled({8, 8});
    settings.transparency = Transparency::weighted;
    EXPECT_NE(settings.problem().value_or("").find("--transparency weighted with --msaa 4"),
              std::string::npos);
    settings.transparency = Transparency::triangles;
    EXPECT_FALSE(settings.problem());
}

}  // namespace
}  // namespace diptych::tests
