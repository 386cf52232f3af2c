// SPDX-License-Identifier: MIT
// The sun of an environment as a light, in both paths and the reference.
#include "shared/scene/lights/environment_sun.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/square.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>

namespace diptych::tests {
namespace {

const std::vector<Channel> sunChannels{Channel::lit, Channel::lit_diffuse, Channel::shadow_visibility,
                                       Channel::material_id};

// Radiance 0.5, and a texel of 2000 at about (1, 0, 1).
constexpr int sunColumn = 112, sunRow = 31;
constexpr double even = 0.5, bright = 2000;
Environment sunny() {
    Environment sky{"sunny", Image(128, 64, 3, static_cast<float>(even))};
    for (int c = 0; c < 3; ++c) sky.radiance.at(sunColumn, sunRow, c) = static_cast<float>(bright);
    return sky;
}
const double sunAzimuth = 2 * std::numbers::pi * (sunColumn + 0.5) / 128 - std::numbers::pi,
             sunPolar = std::numbers::pi * (sunRow + 0.5) / 64;
const glm::dvec3 toSun(std::sin(sunPolar) * std::sin(sunAzimuth), std::cos(sunPolar),
                       -std::sin(sunPolar) * std::cos(sunAzimuth));
const double sunLux =
    (bright - even) * 2 * std::numbers::pi / 128 *
    (std::cos(std::numbers::pi * sunRow / 64) - std::cos(std::numbers::pi * (sunRow + 1) / 64));

// The white Lambertian square, and a small one whose shadow falls on its centre.
Scene sunlitSquare() {
    Scene scene = square();
    scene.environment = sunny();
    Material& m = scene.materials[0];
    m.metallic = 0;
    m.specular = 0;
    m.double_sided = true;
    m.base_color = {1, 1, 1, 1};
    scene.nodes.push_back({"small", -1, glm::dmat4(1), 0});
    scene.nodes.back().parent_from_node =
        glm::scale(glm::translate(glm::dmat4(1), 0.5 / toSun.z * toSun), glm::dvec3(0.15));
    return scene;
}

Settings withSun() {
    Settings settings;
    settings.size = {16, 16};
    settings.gbuffer = GBufferEncoding::full;
    settings.env_sun = true;
    settings.ibl_samples = 16;
    return settings;
}

Frame referenceOf(Renderer& renderer, Settings settings) {
    settings.path = Path::reference;
    return renderer.draw(settings, untimed(sunChannels));
}

// Expected: E / pi of the uniform sky everywhere, plus the sun outside its shadow. The solid angle of a
// texel at the horizon equals that of its tent filter within 0.1 %. The reference's samples of the uniform
// sky are within 1 %.
TEST(EnvironmentSunLight, LightsAndCastsShadows) {
    const Scene scene = sunlitSquare();
    Renderer renderer(device(), scene, pipelines());
    std::vector<Frame> frames = bothPaths(renderer, withSun(), sunChannels);
    EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u);
    frames.push_back(referenceOf(renderer, withSun()));
    for (const Frame& frame : frames) {
        const double tolerance = frame.settings.path == Path::reference ? 0.01 * even : 1e-5;
        EXPECT_NEAR(colorAt(frame, Channel::lit_diffuse, 8, 8).g, even, tolerance) << frame.name;
        EXPECT_EQ(colorAt(frame, Channel::shadow_visibility, 8, 8).x, 0) << frame.name;
        const double lit_by_sun = sunLux * toSun.z / std::numbers::pi;
        EXPECT_NEAR(colorAt(frame, Channel::lit_diffuse, 2, 8).g, even + lit_by_sun,
                    2e-3 * lit_by_sun + tolerance)
            << frame.name;
        EXPECT_EQ(colorAt(frame, Channel::shadow_visibility, 2, 8).x, 1) << frame.name;
        EXPECT_EQ(std::ranges::count_if(frame.notes,
                                        [](const std::string& note) {
                                            return note.starts_with("environment: its sun is a light of ");
                                        }),
                  1)
            << frame.name;
        EXPECT_EQ(frame.counters.lights, 1u) << frame.name;
    }
}

// Rotated by 180 degrees the sun is behind the square: only the uniform sky remains, at intensity 2.
TEST(EnvironmentSunLight, TurnsAndIsScaledWithTheEnvironment) {
    const Scene scene = sunlitSquare();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = with(withSun(), "shadows off ibl-intensity 2");
    const double lit_by_sun = sunLux * toSun.z / std::numbers::pi;
    for (const auto& [turned, expected] : {std::pair{0.0f, 2 * (even + lit_by_sun)},
                                           {180.0f, 2 * even},
                                           {90.0f, 2 * even},  // (x, z) becomes (z, -x)
                                           {-90.0f, 2 * (even + sunLux * toSun.x / std::numbers::pi)}}) {
        settings.env_rotation = turned;
        std::vector<Frame> frames = bothPaths(renderer, settings, sunChannels);
        frames.push_back(referenceOf(renderer, settings));
        for (const Frame& frame : frames)
            EXPECT_NEAR(colorAt(frame, Channel::lit_diffuse, 2, 8).g, expected, 0.005 * expected)
                << frame.name << " " << turned;
    }
}

// The background is the environment image, sun included. A path that integrates the whole image gets the
// same light.
TEST(EnvironmentSunLight, TheImageKeepsItsSun) {
    Scene scene = sunlitSquare();
    scene.nodes.pop_back();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = withSun();
    settings.camera = "eye=0,0,5 target=5,0,10 fov=50 near=0.1 far=100";
    Settings without = settings;
    without.env_sun = false;
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        const Frame with = drawnBy(path, renderer, settings, sunChannels),
                    off = drawnBy(path, renderer, without, sunChannels);
        EXPECT_EQ(with.channels.at(Channel::lit).data, off.channels.at(Channel::lit).data) << with.name;
        EXPECT_GT(*std::ranges::max_element(with.channels.at(Channel::lit).data), 0.5 * bright) << with.name;
        EXPECT_EQ(off.counters.lights, 0u);
    }
    const Frame with = referenceOf(renderer, settings), off = referenceOf(renderer, without);
    EXPECT_EQ(with.channels.at(Channel::lit).data, off.channels.at(Channel::lit).data);
    // The reference samples the sun as part of the image.
    settings.camera.clear();
    without.camera.clear();
    settings.shadows = without.shadows = Shadows::off;
    const double as_light = colorAt(referenceOf(renderer, settings), Channel::lit_diffuse, 8, 8).g,
                 as_image = colorAt(referenceOf(renderer, without), Channel::lit_diffuse, 8, 8).g;
    EXPECT_NEAR(as_light, as_image, 0.01 * as_image);
}

// All rotations share one view if the sun is not a light; images are equal if none is found.
TEST(EnvironmentSunLight, WithoutOneNothingChanges) {
    Scene scene = sunlitSquare();
    scene.environment = Environment{"even", Image(128, 64, 3, 0.5f)};
    Renderer renderer(device(), scene, pipelines());
    Settings settings = withSun();
    Settings without = settings;
    without.env_sun = false;
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        const Frame with = drawnBy(path, renderer, settings, sunChannels),
                    off = drawnBy(path, renderer, without, sunChannels);
        EXPECT_EQ(with.channels.at(Channel::lit).data, off.channels.at(Channel::lit).data) << with.name;
        EXPECT_TRUE(std::ranges::any_of(with.notes, [](const std::string& note) {
            return note.starts_with("environment: --env-sun on: no compact spot ");
        }));
    }
    without.env_rotation = 30;
    SceneViews views(scene);
    const SceneView& first = views.at(viewRequest(without));
    without.env_rotation = 60;
    EXPECT_EQ(&first, &views.at(viewRequest(without)));
}

// Both paths render scenes under it alike, including shadows and other lights.
TEST(EnvironmentSunLight, BothPathsAreEqualBitForBit) {
    Scene scene = loadScene("builtin:lightmaps");
    scene.environment = sunny();
    Settings settings = with(withSun(), "size 96x54 env-rotation 33");
    const std::vector<Frame> frames = bothPaths(scene, settings, sunChannels);
    for (const Channel channel : sunChannels)
        EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u) << debugMode(channel).name;
}

}  // namespace
}  // namespace diptych::tests
