// SPDX-License-Identifier: MIT
// Environment light in both paths: compared with closed forms, ambient light, and the reference.
#include "compare/reference/light/environment.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/environment.h"
#include "shared/environment/environment_maps.h"
#include "shared/environment/octahedral_map.h"
#include "tests/image/skies.h"
#include "tests/image/square.h"
#include "tests/support/layer_formulas.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include <array>
#include <cmath>
#include <random>
#include <set>

namespace diptych::tests {
namespace {

// The square, a smooth metal, mirrors what is behind the camera; the background shows what is in front of
// it.
TEST(EnvironmentLight, SixPaintedDirectionsAreWhereTheyBelong) {
    Scene scene = square();
    scene.environment = paintedSky();
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0;
    scene.materials[0].base_color = {1, 1, 1, 1};
    Renderer renderer(device(), scene, pipelines());
    for (const Frame& frame : bothPaths(renderer, underSky({17, 17}), shown))
        expectColor(colorAt(frame, Channel::lit, 8, 8), painted[4], 1e-3f, frame.name + " mirrors +Z");
    for (std::size_t i = 0; i < axes.size(); ++i) {
        // From in front of the square, with nothing beside its plane.
        Settings settings = underSky({9, 9});
        const glm::vec3 eye(0, 0, 20), to = eye + axes[i];
        settings.camera =
            fmt::format("eye=0,0,{} target={},{},{} fov=5 near=0.1 far=10", eye.z, to.x, to.y, to.z);
        for (const Frame& frame : bothPaths(renderer, settings, shown)) {
            expectColor(colorAt(frame, Channel::lit, 4, 4), painted[i], 1e-6f, frame.name + " sees axis");
            EXPECT_EQ(colorAt(frame, Channel::material_id, 4, 4).x, -1);
            for (const Channel term : {Channel::lit_diffuse, Channel::lit_specular, Channel::lit_ambient,
                                       Channel::lit_environment})
                EXPECT_EQ(colorAt(frame, term, 4, 4), glm::vec3(0)) << "the background is no light term";
        }
    }
    // Rotated counter-clockwise seen from above, +X moves to -Z.
    Settings turned = underSky({9, 9});
    turned.camera = "eye=0,0,20 target=0,0,-1 fov=5 near=0.1 far=10";
    turned.env_rotation = 90;
    turned.ibl_intensity = 2;
    for (const Frame& frame : bothPaths(renderer, turned, shown))
        expectColor(colorAt(frame, Channel::lit, 4, 4), 2.0f * painted[0], 1e-6f, frame.name + " turned");
    turned.camera.clear();
    for (const Frame& frame : bothPaths(renderer, turned, shown))
        expectColor(colorAt(frame, Channel::lit, 4, 4), 2.0f * painted[1], 2e-3f,
                    frame.name + " mirrors what was -X");
}

// A uniform sky equals --ambient, for every method except sampling.
TEST(EnvironmentLight, AConstantSkyIsAmbientLight) {
    Scene scene = loadScene("builtin:dielectrics");
    scene.environment = constantSky(0.75f);
    scene.lights.clear();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = underSky({64, 36});
    settings.ambient = {0.75f, 0.75f, 0.75f};
    for (const IblDiffuse diffuse : {IblDiffuse::sh, IblDiffuse::sh_windowed, IblDiffuse::map}) {
        settings.ibl_diffuse = diffuse;
        for (const Frame& frame : bothPaths(renderer, settings, shown)) {
            double worst = 0;
            int covered = 0;
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 64; ++x) {
                    if (colorAt(frame, Channel::material_id, x, y).x < 0) continue;
                    ++covered;
                    const glm::vec3 sum = colorAt(frame, Channel::lit_diffuse, x, y) +
                                          colorAt(frame, Channel::lit_specular, x, y),
                                    off = glm::abs(sum - colorAt(frame, Channel::lit_ambient, x, y));
                    worst = std::max({worst, double{off.x}, double{off.y}, double{off.z}});
                    ASSERT_EQ(colorAt(frame, Channel::lit_environment, x, y), sum) << frame.name;
                }
            EXPECT_GT(covered, 200);
            EXPECT_LT(worst, 2e-6) << frame.name << " " << nameOf(diffuse);
            EXPECT_EQ(
                std::ranges::count_if(
                    frame.notes, [](const std::string& note) { return note.starts_with("environment: "); }),
                1)
                << frame.name;
        }
    }
}

// The environment's channel is independent of other lights, in one draw or several.
TEST(EnvironmentLight, ItsChannelHasNothingOfTheLights) {
    Scene scene = square();
    scene.environment = paintedSky();
    scene.materials[0].metallic = 0;
    Settings settings = underSky({4, 4});
    settings.assign = Assignment::every;
    const std::vector<Frame> dark = bothPaths(scene, settings, shown);
    Light lamp;
    lamp.position = {0, 0, 0.5};
    lamp.intensity = 1;
    for (const std::size_t lights : {std::size_t{1}, std::size_t{device().profile().light_iterations} + 7}) {
        scene.lights.assign(lights, lamp);
        const std::vector<Frame> shone = bothPaths(scene, settings, shown);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(differingPixels(shone[i], dark[i], Channel::lit_environment), 0u) << lights;
            EXPECT_EQ(differingPixels(shone[i], dark[i], Channel::lit_diffuse), 16u) << lights;
            EXPECT_GT(colorAt(dark[i], Channel::lit_environment, 2, 2).g, 0.01f);
        }
    }
}

// Sampling estimates the same integral: of a metal at every angle in view.
TEST(EnvironmentLight, SamplesAtAPixelAreTheTablesIntegral) {
    Scene scene = square();
    scene.environment = constantSky(1);
    scene.materials[0].metallic = 1;
    scene.materials[0].base_color = {1, 1, 1, 1};
    for (const float roughness : {0.1f, 0.5f, 1.0f}) {
        scene.materials[0].roughness = roughness;
        Settings settings = with(underSky({17, 17}), "ibl sampled ibl-samples 1024 ambient 1,1,1");
        for (const Frame& frame : bothPaths(scene, settings, shown))
            for (const int x : {0, 4, 8})
                EXPECT_NEAR(colorAt(frame, Channel::lit_specular, x, 8).x,
                            colorAt(frame, Channel::lit_ambient, x, 8).x, 3e-3f)
                    << frame.name << " " << roughness << " " << x;
    }
}

// Sampled specular of shaders/lib/environment/environment.glsl for a white metal in z = 0, in double. Each
// sample reads the level whose texels match its solid angle.
double sampledWhite(const EnvironmentMaps& maps, double roughness, const glm::dvec3& v, int count,
                    double bias) {
    const double alpha = roughness * roughness, pi = std::numbers::pi;
    const auto lambda = [&](double cosine) {
        return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1);
    };
    const glm::dvec3 up = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const glm::dvec3 t1 = glm::normalize(glm::dvec3(-up.y, up.x, 0)), t2 = glm::cross(up, t1);
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        double reversed = 0;
        for (int bit = 0; bit < 32; ++bit) reversed += (i >> bit & 1) * std::exp2(-bit - 1);
        const double turn = (reversed + 0.5 / count) * 2 * pi, radius = std::sqrt((i + 0.5) / count);
        const double p1 = radius * std::cos(turn), s = 0.5 * (1 + up.z);
        const double p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * radius * std::sin(turn);
        glm::dvec3 h = t1 * p1 + t2 * p2 + up * std::sqrt(std::max(1 - p1 * p1 - p2 * p2, 0.0));
        h = glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, h.z));
        const glm::dvec3 l = 2 * glm::dot(v, h) * h - v;
        if (l.z <= 0) continue;
        const double density = ggx(alpha, h.z) / (4 * v.z * (1 + lambda(v.z)));
        // A texel covers 4 / side^2 of [-1, 1]^2, and that times |d|_1^3 in sr (octahedral_map.h).
        const double l1 = std::abs(l.x) + std::abs(l.y) + std::abs(l.z), side = maps.levels[0].side;
        const double texel = 4 / (side * side) * l1 * l1 * l1;
        const double last = static_cast<double>(maps.levels.size()) - 1;
        const double mip = std::clamp(0.5 * std::log2(1 / (count * density) / texel) + bias, 0.0, last);
        const auto lower = static_cast<std::size_t>(std::min(mip, last - 1));
        const glm::vec2 point = octahedralPosition(glm::vec3(l));
        sum +=
            glm::mix(double{maps.levels[lower].interpolated(point).x},
                     double{maps.levels[lower + 1].interpolated(point).x}, mip - static_cast<double>(lower)) *
            (1 + lambda(v.z)) / (1 + lambda(v.z) + lambda(l.z));
    }
    return sum / count;
}

// Under a noise sky, of which each level is a different image.
TEST(EnvironmentLight, ASampleReadsTheLevelOfItsSolidAngle) {
    Scene scene = square();
    Image noise(64, 32, 3);
    std::mt19937 random(4);
    for (std::size_t i = 0; i < noise.pixels(); ++i)
        std::fill_n(noise.pixel(i), 3, static_cast<float>(random() % 1000) / 500);
    scene.environment = Environment{"noise", noise};
    scene.materials[0].metallic = 1;
    scene.materials[0].base_color = {1, 1, 1, 1};
    Settings settings = with(underSky({17, 17}), "ibl sampled ibl-samples 16 ambient 1,1,1");
    const EnvironmentMaps maps = makeEnvironmentMaps(*scene.environment, {.quality = {}, .prefilter = false});
    for (const auto& [roughness, bias] :
         {std::pair(0.3f, 0.0f), std::pair(0.6f, 0.0f), std::pair(0.4f, 0.5f)}) {
        scene.materials[0].roughness = roughness;
        settings.ibl_bias = bias;
        Renderer renderer(device(), scene, pipelines());
        const Frame frame = drawnBy(Path::forward_plus, renderer, settings, shown);
        for (int y = 0; y < 17; y += 4)
            for (int x = 0; x < 17; x += 4) {
                if (x == 8 && y == 8) continue;  // where any tangent axis is correct
                const glm::dvec3 p((x + 0.5) / 8.5 - 1, 1 - (y + 0.5) / 8.5, 0);
                const double expected = sampledWhite(
                    maps, double{roughness}, glm::normalize(glm::dvec3(0, 0, 1) - p), 16, double{bias});
                EXPECT_NEAR(colorAt(frame, Channel::lit_specular, x, y).x, expected, 1e-3 * expected)
                    << roughness << " " << bias << " " << x << "," << y;
            }
    }
}

TEST(EnvironmentLight, OcclusionTexturesDimIt) {
    Scene scene = square();
    scene.environment = constantSky(1);
    Material& m = scene.materials[0];
    m.metallic = 0;
    m.base_color = {0.5f, 0.5f, 0.5f, 1};
    const std::vector<Frame> open = bothPaths(scene, underSky({4, 4}), shown);
    m.occlusion_texture.texture = 0;  // red: 1 and 0 above, 0 and 0.2 below
    m.occlusion_strength = 0.75f;
    const std::vector<Frame> dimmed = bothPaths(scene, underSky({4, 4}), shown);
    for (std::size_t i = 0; i < 2; ++i)
        for (const Channel term : {Channel::lit_diffuse, Channel::lit_specular}) {
            expectColor(colorAt(dimmed[i], term, 0, 0), colorAt(open[i], term, 0, 0), 1e-6f, "open");
            expectColor(colorAt(dimmed[i], term, 3, 0), 0.25f * colorAt(open[i], term, 3, 0), 1e-6f,
                        "a quarter");
            EXPECT_GT(colorAt(open[i], term, 3, 0).x, 0.01f);
        }
}

// No pass and no feature without an environment or at intensity 0.
TEST(EnvironmentLight, NothingIsAddedWhereThereIsNone) {
    const auto isDrawn = [](const Scene& scene, const Settings& settings) {
        SharedResources shared(device(), scene, pipelines());
        SceneViews views(scene);
        const PreparedFrame frame(device(), shared, views.at(viewRequest(settings)), settings);
        const auto names = frame.passes.names();
        const bool background = std::ranges::count(names, "background") > 0;
        EXPECT_EQ(background, frame.view.inputs.variant.get(gpu::FEATURE_environment) != 0);
        EXPECT_EQ(background, shared.environments.bytes() > 0);
        return background;
    };
    Scene scene = square();
    for (const Path path : drawn_paths) {
        Settings settings = underSky();
        settings.path = path;
        scene.environment.reset();
        EXPECT_FALSE(isDrawn(scene, settings)) << nameOf(path);
        scene.environment = constantSky(1);
        EXPECT_TRUE(isDrawn(scene, settings)) << nameOf(path);
        settings.ibl_intensity = 0;
        EXPECT_FALSE(isDrawn(scene, settings)) << nameOf(path);
    }
}

// With --gbuffer full both paths are equal, however the environment is evaluated.
TEST(EnvironmentLight, BothPathsAreEqualBitForBit) {
    Scene scene = loadScene("builtin:gallery");
    scene.environment = paintedSky();
    Renderer renderer(device(), scene, pipelines());
    for (const Ibl ibl : {Ibl::split, Ibl::sampled}) {
        Settings settings = with(underSky({96, 54}), "lights point:8,spot:4 env-rotation 33");
        settings.ibl = ibl;
        settings.ibl_diffuse = ibl == Ibl::split ? IblDiffuse::sh : IblDiffuse::map;
        const std::vector<Frame> frames = bothPaths(renderer, settings, shown);
        for (const Channel channel : shown)
            EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u)
                << nameOf(ibl) << " " << debugMode(channel).name;
        for (const Frame& frame : frames) EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << frame.name;
    }
}

class AssetEnvironment : public SceneTest {};

// The same for real scenes with 256 lights, haze, and shadows of the sun and lamps. Scenes with blending
// use every transparency mode.
TEST_P(AssetEnvironment, IsEqualBitForBit) {
    Scene scene = loadScene(name());
    scene.environment = paintedSky();
    Settings settings = with(underSky({128, 72}),
                             "lights point:192,spot:64 haze on haze-density 100 shadows pcf shadow-lights 4");
    const bool blends = std::ranges::any_of(scene.materials, [](const Material& m) {
        return m.alpha_mode == AlphaMode::blend || m.transmission > 0;
    });
    Renderer renderer(device(), scene, pipelines());
    for (const auto& [transparency, name] : enumNames<Transparency>()) {
        settings.transparency = transparency;
        const std::vector<Frame> frames = bothPaths(renderer, settings, shown);
        for (const Channel channel : shown)
            EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u)
                << name << ": " << debugMode(channel).name;
        for (const Frame& frame : frames) {
            EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << name << ": " << frame.name;
            EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << name << ": " << frame.name;
        }
        if (!blends) break;  // other modes add no pass: Transparent.WithoutBlendingThereIsNoPass
    }
}

INSTANTIATE_TEST_SUITE_P(Asset, AssetEnvironment, testing::ValuesIn(slice(assetScenes(), 4)), sceneName);

// A scene rotated with its environment and camera looks the same: the maps favour no direction.
TEST(EnvironmentLight, TurnsWithTheScene) {
    constexpr float degrees = 37;
    Scene scene = loadScene("builtin:gallery");
    scene.environment = paintedSky();
    scene.lights.clear();
    Scene turned = scene;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(double{degrees}), {0, 1, 0});
    const auto root = static_cast<int>(turned.nodes.size());
    for (Node& node : turned.nodes)
        if (node.parent < 0) node.parent = root;
    turned.nodes.push_back({.name = "turn", .parent_from_node = turn});
    for (Camera& camera : turned.cameras) camera.world_from_camera = turn * camera.world_from_camera;
    Settings settings = underSky({160, 90});
    ASSERT_FALSE(scene.cameras.empty());
    const std::vector<Frame> still = bothPaths(scene, settings, shown);
    settings.env_rotation = degrees;
    const std::vector<Frame> moved = bothPaths(turned, settings, shown);
    for (std::size_t path = 0; path < 2; ++path) {
        std::size_t off = 0;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                off += glm::any(glm::greaterThan(glm::abs(colorAt(moved[path], Channel::lit, x, y) -
                                                          colorAt(still[path], Channel::lit, x, y)),
                                                 glm::vec3(1e-3f)));
        EXPECT_LE(off, 14u) << still[path].name;  // 0.1 %
    }
}

// The background is the environment image itself; float32 leaves an angular error of 1e-6.
TEST(EnvironmentLight, TheBackgroundIsTheImage) {
    Scene scene = square();
    scene.environment = paintedSky();
    for (std::size_t i = 0; i < scene.environment->radiance.data.size(); ++i)
        scene.environment->radiance.data[i] += static_cast<float>(i % 11) / 11;
    const reference::EnvironmentLight light(*scene.environment, 1.5, glm::radians(40.0));
    Settings settings = underSky({32, 32});
    settings.camera = "eye=0,0,5 target=1,3,9 fov=120 near=0.1 far=100";
    settings.env_rotation = 40;
    settings.ibl_intensity = 1.5f;
    SceneViews views(scene);
    const View& view = views.at(viewRequest(settings)).view;
    const auto gpuView = view.gpuView();
    for (const Frame& frame : bothPaths(scene, settings, shown))
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                if (colorAt(frame, Channel::material_id, x, y).x >= 0) continue;
                const glm::dvec3 d = glm::normalize(glm::dvec3(gpuView.direction_0) +
                                                    glm::dvec3(gpuView.direction_x) * (x + 0.5) +
                                                    glm::dvec3(gpuView.direction_y) * (y + 0.5));
                expectColor(colorAt(frame, Channel::lit, x, y), glm::vec3(light.radiance(d)), 2e-4f,
                            frame.name);
            }
}

}  // namespace
}  // namespace diptych::tests
