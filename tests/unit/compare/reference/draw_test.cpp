// SPDX-License-Identifier: MIT
// Complete images of the reference: every light and channel, shadows, threads, resuming.
#include "tests/support/reference_scene.h"

#include "compare/reference/checkpoint.h"
#include "compare/reference/time_estimate.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"
#include "tests/support/files.h"
#include "tests/support/light_kinds.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace diptych::reference {
namespace {

// Value of one pixel that looks straight down at the floor's centre, float32.
double seenBelow(const Scene& scene, bool shadows = false) {
    const Drawn d = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01), shadows);
    return double{d[Channel::lit].at(0, 0, 0)};
}

// ---- kinds and channels ------------------------------------------------------------------------------

class ReferenceDrawOf : public testing::TestWithParam<LightKind> {};

TEST_P(ReferenceDrawOf, ALightInEveryChannel) {
    Scene scene = floorScene();
    scene.lights = {lightOf(GetParam(), {0, 0, 2})};
    scene.lights[0].intensity = 3;
    const Drawn d = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 3, 3, 0.01));
    for (const DebugMode& mode : debugModes()) {
        ASSERT_EQ(d.image.channels.contains(mode.channel), isSupportedByReference(mode)) << mode.name;
        if (!isSupportedByReference(mode)) continue;
        const Image& image = d.image.channels.at(mode.channel);
        EXPECT_EQ(image.components, mode.width) << mode.name;
        for (const float v : image.data) EXPECT_TRUE(std::isfinite(v)) << mode.name;
    }
    const double expected = irradianceFrom(scene.lights[0], {0, 0, 1}) / pi;
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(double{d[Channel::lit].at(1, 1, 0)}, expected, 1e-6 * expected);
    EXPECT_EQ(d[Channel::lit_specular].at(1, 1, 0), 0) << "nothing but Lambertian";
}

TEST(ReferenceDraw, Channels) {
    Scene scene = floorScene();
    Material& m = scene.materials[0];
    m.base_color = {0.5f, 0.25f, 0.125f, 1};
    m.metallic = 0.5f;
    m.roughness = 0.75f;
    m.emissive = {1, 2, 4};
    m.specular = 0.5f;
    const Drawn d = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01));
    const auto value = [&](Channel mode, int c = 0) { return double{d[mode].at(0, 0, c)}; };
    EXPECT_EQ(value(Channel::albedo, 2), 0.125);
    EXPECT_EQ(value(Channel::metallic), 0.5);
    EXPECT_EQ(value(Channel::roughness), 0.75);
    EXPECT_EQ(value(Channel::emission, 1), 2);
    EXPECT_EQ(value(Channel::lit, 2), 4) << "what it emits, without lights";
    EXPECT_EQ(value(Channel::occlusion), 1);
    EXPECT_EQ(value(Channel::dielectric_f90), 0.5);
    EXPECT_NEAR(value(Channel::specular, 1), 0.5 * 0.04 * 0.5 + 0.25 * 0.5, 1e-8)
        << "half metal, half dielectric";
    EXPECT_EQ(value(Channel::normals, 2), 1);
    EXPECT_EQ(value(Channel::geometric_normal, 2), 1);
    EXPECT_NEAR(value(Channel::depth), 3, 1e-6);
    EXPECT_NEAR(value(Channel::position, 2), -3, 1e-6);
    EXPECT_EQ(value(Channel::material_id), 0);
    EXPECT_NEAR(value(Channel::texcoords, 1), 0.5, 1e-6);
    EXPECT_NEAR(value(Channel::dielectric_f0, 1), 0.5 * 0.04, 1e-8) << "whatever the metal is";
    for (const Channel mode : {Channel::tangent, Channel::handedness, Channel::tangent_normal})
        EXPECT_EQ(value(mode), 0) << "there is no normal map";
    const Drawn empty = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 9}, 1, 1, 0.01));
    for (const DebugMode& mode : debugModes()) {
        if (!isSupportedByReference(mode)) continue;
        EXPECT_EQ(empty.image.channels.at(mode.channel).data[0], mode.name == "material_id" ? -1 : 0)
            << mode.name;
    }
}

// ---- shadows -----------------------------------------------------------------------------------------

// A roof of 1 m, 1 m above the floor's centre, between floor and light; the camera is below the roof.
Scene roofed(const Material& of, LightKind kind = LightKind::point) {
    Scene scene = floorScene();
    scene.materials.push_back(of);
    add(scene, quad({-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}, 1));
    scene.lights = {lightOf(kind, {0, 0, 2})};
    return scene;
}
double below(const Scene& scene) {
    const Drawn d = drawn(scene, viewFrom({0, 0, 0.5}, {0, 0, 0}, 1, 1, 0.01), true);
    return double{d[Channel::lit].at(0, 0, 0)} * pi;
}

TEST_P(ReferenceDrawOf, ARoofShadesTheFloor) {
    Scene scene = roofed(matte(), GetParam());
    scene.lights[0].width = scene.lights[0].height = 0.5f;
    scene.lights[0].radius = 0.25f;
    EXPECT_EQ(below(scene), 0);
    scene.meshes[0].primitives.pop_back();
    EXPECT_GT(below(scene), 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReferenceDrawOf, testing::ValuesIn(everyLightKind()), lightKindName);

TEST(ReferenceDraw, WhatCastsAShadow) {
    Material m = matte();
    EXPECT_EQ(below(roofed(m)), 0);
    m.alpha_mode = AlphaMode::blend;
    EXPECT_NEAR(below(roofed(m)), 0.25, 1e-6) << "what blends throws none";
    m.alpha_mode = AlphaMode::mask;
    m.base_color.a = 0.49f;
    EXPECT_NEAR(below(roofed(m)), 0.25, 1e-6) << "cut out";
    m.base_color.a = 0.51f;
    EXPECT_EQ(below(roofed(m)), 0);
    // Occluders beyond or beside the light cast no shadow.
    Scene scene = roofed(matte());
    scene.lights[0].position.z = 0.9;
    EXPECT_NEAR(below(scene), 1 / 0.81, 1e-5);
    scene = roofed(matte());
    scene.lights[0].position = {1.5, 0, 1.4};  // its ray crosses z = 1 at x = 1.07
    EXPECT_NEAR(below(scene), 1.4 / std::pow(1.5 * 1.5 + 1.4 * 1.4, 1.5), 1e-6);
}

TEST(ReferenceDraw, AMaskThrowsTheShadowOfItsHoles) {
    Material m = matte();
    m.alpha_mode = AlphaMode::mask;
    m.base_color_texture.texture = 0;
    Scene scene = roofed(m);
    scene.textures = {{0, {}}};
    scene.textures[0].sampler.magnify_linear = false;
    scene.images = {{"holes", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}}};  // solid for u < 1/2
    scene.lights[0].position = {0.5, 0, 2};
    EXPECT_GT(below(scene), 0.1) << "its ray crosses the roof at x = 0.25, u = 0.75";
    scene.lights[0].position = {-0.5, 0, 2};
    EXPECT_EQ(below(scene), 0);
}

// glTF 2.0, 3.9.4: alpha equal to the cutoff is opaque, for every 8-bit code and its float rounding.
// Tested from the camera above and from the light.
TEST(ReferenceDraw, AlphaThatEqualsTheCutoffIsOpaque) {
    Material m = matte();
    m.alpha_mode = AlphaMode::mask;
    m.base_color_texture.texture = 0;
    Scene scene = roofed(m);
    scene.textures = {{0, {}}};
    for (int code = 1; code < 256; ++code) {
        scene.images = {{"flat", 1, 1, {255, 255, 255, static_cast<std::uint8_t>(code)}}};
        Material& roof = scene.materials.back();
        roof.alpha_cutoff = static_cast<float>(code / 255.0);
        EXPECT_EQ(below(scene), 0) << code;
        EXPECT_NEAR(seenBelow(scene), 1 / pi, 1e-6) << code << ", the roof";
        roof.alpha_cutoff = std::nextafter(roof.alpha_cutoff, 2.0f);
        EXPECT_NEAR(below(scene), 0.25, 1e-6) << code;
        EXPECT_NEAR(seenBelow(scene), 0.25 / pi, 1e-6) << code << ", the floor";
    }
}

// With shadows, light from behind the triangle does not reach it. Without shadows only the shading normal
// decides.
TEST(ReferenceDraw, LightFromBehindTheTriangle) {
    Scene scene = floorScene();
    for (glm::vec3& n : scene.meshes[0].primitives[0].normals) n = glm::normalize(glm::vec3(1, 0, 1));
    scene.lights = {lightOf(LightKind::directional, {0, 0, 0}, {-1, 0, 0.2})};
    EXPECT_GT(seenBelow(scene), 0.1);
    EXPECT_EQ(seenBelow(scene, true), 0);
}

// At the end of a light's range its window is the difference of almost equal numbers.
TEST(ReferenceDraw, WhatFloat32ErrsByIsKeptWhereItCounts) {
    Scene scene = floorScene();
    scene.lights = {lightOf(LightKind::point, {0, 0, 2})};
    const View view = viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01);
    for (const float range : {20.0f, 2.0001f}) {
        scene.lights[0].range = range;
        const Drawn d = drawn(scene, view);
        ASSERT_EQ(d.image.rounding.empty(), range == 20);
        if (range == 20) continue;
        const double ratio =
            double{d.image.rounding.at(0, 0, 0)} / double{d[Channel::lit_diffuse].at(0, 0, 0)};
        EXPECT_GT(ratio, 0.001);
        EXPECT_LT(ratio, 0.02);
    }
}

// So is the attenuation at the edge of a cone.
TEST(ReferenceDraw, WhatFloat32ErrsByIsKeptAtTheEdgeOfACone) {
    Scene scene = floorScene();
    const View view = viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01);
    for (const double inside : {0.5, 0.002}) {  // 0 at the outer cone, 1 at the inner one
        const double angle = std::acos(std::cos(0.5) + inside * (std::cos(0.4) - std::cos(0.5)));
        Light light = lightOf(LightKind::spot, {0, 0, 2}, {std::sin(angle), 0, -std::cos(angle)});
        light.inner_cone = 0.4f;
        light.outer_cone = 0.5f;
        scene.lights = {light};
        const Drawn d = drawn(scene, view);
        ASSERT_EQ(d.image.rounding.empty(), inside == 0.5);
        if (inside == 0.5) continue;
        const double ratio =
            double{d.image.rounding.at(0, 0, 0)} / double{d[Channel::lit_diffuse].at(0, 0, 0)};
        // A cosine errs by a few times 2^-24, and is 9e-5 from the edge's.
        EXPECT_GT(ratio, 0.001);
        EXPECT_LT(ratio, 0.02);
    }
}

TEST(ReferenceDraw, LayersThatBlendAreLaidOver) {
    Scene scene = floorScene();
    Material m = matte();
    m.alpha_mode = AlphaMode::blend;
    m.base_color = {0, 0, 0, 0.25f};
    m.emissive = {8, 8, 8};
    scene.materials.push_back(m);
    scene.materials[0].emissive = {1, 1, 1};
    add(scene, quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, 1));
    add(scene, quad({-1, -1, 0.5}, {2, 0, 0}, {0, 2, 0}, 1));
    EXPECT_NEAR(seenBelow(scene), 0.25 * 8 + 0.75 * (0.25 * 8 + 0.75 * 1), 1e-6);
    // Two at the same depth: the later one is in front.
    scene.materials.push_back(m);
    scene.materials.back().emissive = {4, 4, 4};
    add(scene, quad({-1, -1, 0.5}, {2, 0, 0}, {0, 2, 0}, 2));
    EXPECT_NEAR(seenBelow(scene), 0.25 * 8 + 0.75 * (0.25 * 4 + 0.75 * (0.25 * 8 + 0.75 * 1)), 1e-6);
}

// A light on a ceiling whose float32 vertices are rounded above, onto or below it. Its light arrives, and
// an object between still casts a shadow.
TEST(ReferenceDraw, ALampMayLieOnACeiling) {
    for (const double height : {2.0, 2.3, 2.5, 2.7}) {
        Scene scene = floorScene();
        add(scene, quad({-5, 5, static_cast<float>(height)}, {10, 0, 0}, {0, -10, 0}));  // faces down
        for (const LightKind kind : {LightKind::rect, LightKind::disc, LightKind::point}) {
            Light lamp;
            lamp.kind = kind;
            lamp.position = {0, 0, height};
            lamp.direction = {0, 0, -1};
            scene.lights = {lamp};
            const View view = viewFrom({3, 0, 1.5}, {0, 0, 0}, 5, 5);
            const Image open = drawn(scene, view)[Channel::lit],
                        shaded = drawn(scene, view, true)[Channel::lit];
            for (std::size_t i = 0; i < open.pixels(); ++i)
                EXPECT_NEAR(shaded.pixel(i)[0], open.pixel(i)[0], 1e-5f * open.pixel(i)[0])
                    << height << " " << i;
            add(scene, quad({-4, 4, 1.9f}, {8, 0, 0}, {0, -8, 0}));
            EXPECT_EQ(drawn(scene, view, true)[Channel::lit].at(2, 2, 0), 0) << "a board between";
            scene.meshes[0].primitives.pop_back();
        }
    }
}

// The mean of a coarse image with many samples equals that of a fine image, also at silhouettes and for
// any pixel centres.
TEST(ReferenceDraw, SamplesAreTheMeanOverThePixel) {
    Scene scene = floorScene();
    scene.materials[0].emissive = {1, 1, 1};
    scene.meshes[0].primitives = {quad({-0.83f, -0.61f, 0}, {1.5f, 0.3f, 0}, {-0.2f, 1.1f, 0})};
    const auto mean = [](const Image& lit) {
        double sum = 0;
        for (std::size_t i = 0; i < lit.pixels(); ++i) sum += double{lit.pixel(i)[0]};
        return sum / static_cast<double>(lit.pixels());
    };
    const double fine = mean(drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 320, 240))[Channel::lit]);
    const double coarse = mean(drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 8, 6), false, 1600)[Channel::lit]);
    EXPECT_NEAR(coarse, fine, 0.005 * fine);
    const double one = mean(drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 8, 6))[Channel::lit]);
    EXPECT_GT(std::abs(one - fine), 0.01 * fine) << "one sample is not, or this would show nothing";
}

// ---- threads and interruptions -----------------------------------------------------------------------

// A sampled light, and an environment with radiance `sky`.
Scene sampledScene(float sky = 0) {
    Scene scene = roofed(matte(), LightKind::rect);
    scene.environment = Environment{"sky", Image(8, 4, 3, sky)};
    scene.materials[0].specular = 1;
    scene.materials[0].roughness = 0.3f;
    return scene;
}
const View sampledView = viewFrom({2, 1, 1.5}, {0, 0, 0}, 40, 36);

void expectSame(const ReferenceImage& a, const ReferenceImage& b) {
    ASSERT_EQ(a.channels.size(), b.channels.size());
    for (const auto& [mode, image] : a.channels)
        EXPECT_EQ(image.data, b.channels.at(mode).data) << debugMode(mode).name;
    EXPECT_EQ(a.uncertainty.data, b.uncertainty.data);
    EXPECT_FALSE(a.uncertainty.empty());
}

TEST(ReferenceDraw, TheSameImageWhateverTheNumberOfThreads) {
    const Scene scene = sampledScene(0.2f);
    const View view = viewFrom({2, 1, 1.5}, {0, 0, 0}, 33, 2);
    const Drawn many = drawn(scene, view, true);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    expectSame(many.image, drawn(scene, view, true).image);
}

TEST(ReferenceDraw, StoppedItGoesOnFromWhatIsKept) {
    const Scene scene = sampledScene();
    const Drawn whole = drawn(scene, sampledView, true);
    const std::filesystem::path keep = folder() / "kept";
    std::atomic<int> tiles{0};
    EXPECT_THROW(drawn(scene, sampledView, true, 1, keep,
                       [&](double) {
                           if (++tiles == 4) throw std::runtime_error("stop");
                       }),
                 std::runtime_error);
    EXPECT_EQ(namesIn(keep.parent_path()).size(), 1u);
    std::atomic<int> rest{0};
    const Drawn again = drawn(scene, sampledView, true, 1, keep, [&](double) { ++rest; });
    expectSame(whole.image, again.image);
    EXPECT_GE(rest, 1);
    EXPECT_LE(rest, 9 - 4) << "of nine tiles four are done";
    // The finished file stays until the caller removes it.
    rest = 0;
    expectSame(whole.image, drawn(scene, sampledView, true, 1, keep, [&](double) { ++rest; }).image);
    EXPECT_EQ(rest, 0);
}

// Everything that affects a pixel also decides whether a file belongs to the same image.
TEST(ReferenceDraw, AnotherImageIsBegunAnew) {
    Scene scene = sampledScene();
    scene.lights[0].kind = LightKind::point;
    const std::vector<std::pair<const char*, void (*)(Scene&, View&)>> changes{
        {"light", [](Scene& s, View&) { s.lights[0].intensity = 2; }},
        {"light's place", [](Scene& s, View&) { s.lights[0].position.x = 0.1; }},
        {"material", [](Scene& s, View&) { s.materials[1].roughness = 0.5f; }},
        {"geometry", [](Scene& s, View&) { s.meshes[0].primitives[1].positions[0].x -= 1; }},
        {"node", [](Scene& s, View&) { s.nodes[0].parent_from_node[3].z = 0.1; }},
        {"sky", [](Scene& s, View&) { s.environment->radiance.data[0] = -0.0f; }},  // also black, other bits
        {"sky's shape",
         [](Scene& s, View&) { s.environment->radiance.width = 4, s.environment->radiance.height = 8; }},
        {"camera", [](Scene&, View& v) { v.camera.world_from_camera[3].x += 0.1; }},
        {"size", [](Scene&, View& v) { v.width = 39; }}};
    for (const auto& [name, change] : changes) {
        const std::filesystem::path keep = folder() / "kept";
        std::atomic<int> done{0};
        const auto stop = [&](double) {
            if (++done == 2) throw std::runtime_error("stop");
        };
        EXPECT_THROW(drawn(scene, sampledView, true, 1, keep, stop), std::runtime_error);
        Scene changed = scene;
        View view = sampledView;
        change(changed, view);
        // The first progress report reveals how many tiles remain.
        std::mutex one;
        double min = 1;
        const auto first = [&](double fraction) {
            const std::lock_guard lock(one);
            min = std::min(min, fraction);
            throw std::runtime_error("stop");
        };
        EXPECT_THROW(drawn(changed, view, true, 1, keep, first), std::runtime_error);
        EXPECT_EQ(min, 1.0 / 9) << name;
        EXPECT_EQ(namesIn(keep.parent_path()).size(), 2u)
            << name << ": what is kept of the first is left alone";
    }
}

// The run-time estimate uses pixels from the whole image and is available early.
TEST(ReferencePace, ComesFromPixelsOfTheWholeImage) {
    std::array<std::array<std::atomic<int>, 4>, 4> drawn{};
    const auto slow = [&](int x, int y) {
        ++drawn[static_cast<std::size_t>(y / 50)][static_cast<std::size_t>(x / 50)];
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    const auto seconds = reference::expectedSeconds(200, 200, slow);
    ASSERT_TRUE(seconds.has_value());
    // 40,000 pixels of at least 1 ms each, on all cores.
    EXPECT_GE(*seconds, 40.0 / tbb::info::default_concurrency() / 2);
    int all = 0;
    for (const auto& row : drawn)
        for (const std::atomic<int>& part : row) {
            EXPECT_GT(part, 0);
            all += part;
        }
    EXPECT_LE(all, 400) << "a hundredth";
    EXPECT_FALSE(reference::expectedSeconds(200, 200, [](int, int) {}).has_value()) << "done at once";
    // The estimate ends however long a pixel takes.
    std::atomic<int> few = 0;
    reference::expectedSeconds(
        4000, 4000, [&](int, int) { ++few, std::this_thread::sleep_for(std::chrono::milliseconds(10)); },
        std::chrono::milliseconds(50));
    EXPECT_LT(few, 160000) << "not its hundredth";
}

}  // namespace
}  // namespace diptych::reference
