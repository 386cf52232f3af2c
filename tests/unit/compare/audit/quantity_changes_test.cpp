// SPDX-License-Identifier: MIT
// What each quantity is, and what it does to a scene, in closed form.
#include "compare/audit/quantities.h"
#include "shared/scene/default_view.h"
#include "tests/support/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace diptych::audit {

namespace {

const Quantity& quantityCalled(const std::string& name) {
    return *quantitiesOf(std::array{name}).front();
}

Light lampAt(LightKind kind, const glm::dvec3& position, float intensity) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.intensity = intensity;
    return light;
}

// The eye at the origin looks along -Z at a triangle 8 m away, in a scene with a radius of 6 m. A sun, a
// point, a spot and a rectangular light; one material with a normal map, and one without.
Subject oneTriangle() {
    Subject subject;
    subject.bounds = {{-2, -4, -12}, {2, 4, -4}};
    subject.has_surface = true;
    subject.point = {0, 0, -8};
    subject.normal = {0, 0, 1};
    subject.nearest = 4;
    subject.view.width = 64;
    subject.view.height = 36;
    subject.original.settings.size = {64, 36};
    Scene& scene = subject.original.scene;
    Primitive triangle;
    triangle.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    triangle.normals.assign(3, {0, 0, 1});
    triangle.tangents.assign(3, {1, 0, 0, -1});
    triangle.indices = {0, 1, 2};
    scene.meshes = {{"triangle", {triangle}}};
    scene.nodes = {{.name = "parent"}, {.name = "drawn", .parent = 0, .mesh = 0}};
    scene.materials.resize(2);
    scene.materials[0].normal_texture.texture = 0;
    scene.lights = {lampAt(LightKind::directional, {}, 2), lampAt(LightKind::point, {0, 4, -8}, 8),
                    lampAt(LightKind::spot, {3, 0, -4}, 4), lampAt(LightKind::rect, {0, 0, -6}, 16)};
    scene.lights[1].range = 5;
    scene.lights[2].range = 7;
    scene.cameras.push_back(subject.view.camera);
    return subject;
}

Case changedBy(const std::string& quantity, const Subject& subject, double magnitude) {
    Case changed = subject.original;
    quantityCalled(quantity).apply(changed, subject, magnitude);
    return changed;
}

std::string flagsOf(const Quantity& quantity) {
    std::string flags;
    for (const auto& [flag, name] : {std::pair{quantity.same_image, "same image"},
                                     {quantity.light, "light"},
                                     {quantity.lengths, "lengths"},
                                     {quantity.of_images, "of images"},
                                     {quantity.whole, "whole"}})
        if (flag) flags += fmt::format("; {}", name);
    for (const Change& change : quantity.variants)
        flags += fmt::format("; {} {}", change.option, change.value);
    return flags;
}

}  // namespace

// A row for each: unit, magnitudes, the scene's own, and how it is tried.
TEST(AuditQuantities, TheirTableIsThis) {
    const Subject subject = oneTriangle();
    std::vector<std::string> rows;
    for (const Quantity& quantity : quantities())
        rows.push_back(fmt::format(
            "{} [{}] {:.4g}: {:.5g}{}", quantity.name, quantity.unit, fmt::join(quantity.magnitudes, " "),
            quantity.name == "environment" ? 1 : quantity.original(subject), flagsOf(quantity)));
    const std::string far =
        " 1e-09 1e-08 1e-07 1e-06 1e-05 0.0001 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06 1e+07";
    const std::vector<std::string> expected{
        "offset [m] 0 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08: 0; same image",
        "vertex [m] 0 1 10 100 1000 1e+04 1e+05 1e+06 1e+07: 0",
        "scale [] 1e-06 1e-05 0.0001 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06: 1; same image; lengths",
        "exposure [] 1e-30 1e-27 1e-24 1e-21 1e-18 1e-15 1e-12 1e-09 1e-06 0.001 1 1000 1e+06 1e+09 1e+12 "
        "1e+15 "
        "1e+18 1e+21 1e+24 1e+27 1e+30: 1; of images",
        // The far plane is twice as far as everything, 2 (8 + 6) m, the near plane at 0.1 m.
        "near [] 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08 1e+09: 280; depth-format d32f-standard; depth-format "
        "d24; "
        "depth-format d16",
        "fov [degrees] 0.01 0.1 1 10 30 60 90 120 150 170 179: 60",
        "grazing [degrees] 0.001 0.01 0.1 1 10 30 60 90: 90",
        "intensity [] 1e-12 1e-11 1e-10 1e-09 1e-08 1e-07 1e-06 1e-05 0.0001 0.001 0.01 0.1 1 10 100 1000 "
        "1e+04 "
        "1e+05 1e+06 1e+07 1e+08 1e+09 1e+10 1e+11 1e+12: 1; same image; light; lit-format fp16; lit-format "
        "b10g11r11",
        "range [m] 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08 1e+09: 7",
        "distance [m] 0" + far + ": 2",  // of the rectangle
        "eye [m] 0" + far + ": 5",       // of the spot light
        "cone [degrees] 0.01 0.1 1 10 30 90 150 179 180: 90",
        "environment [] 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08 1e+09 1e+10 1e+11 1e+12: 1; ibl sampled",
        "roughness [] 0 1e-06 1e-05 0.0001 0.001 0.01 0.02 0.03 0.045 0.06 0.1 0.2 0.5 1: 1; "
        "shading-precision "
        "fp16",
        "normal_map [] 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08 1e+09: 1",
        "texel [] 0 1e-05 0.003922 0.007843 0.05 0.2 0.5 0.9961 1: 1",
        "emission [W/(sr m^2)] 1e-12 1e-10 1e-08 1e-06 0.0001 0.01 1 100 1e+04 1e+06 1e+08 1e+10 1e+12 1e+14 "
        "1e+16 "
        "1e+18 1e+20 1e+22 1e+24 1e+26 1e+28 1e+30 1e+32 1e+34 1e+36 1e+38: 1",
        "color [] 1e-38 1e-36 1e-34 1e-32 1e-30 1e-28 1e-26 1e-24 1e-22 1e-20 1e-18 1e-16 1e-14 1e-12 1e-10 "
        "1e-08 "
        "1e-06 0.0001 0.01 1: 1",
        "shadow_depth [m] 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 1e+08: 6; shadows evsm; shadows msm4",
        "evsm_exponent [] 1 2 5 10 20 30 40 44 44.36: 10",
        "haze [] 1e-09 1e-08 1e-07 1e-06 1e-05 0.0001 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06 1e+07 "
        "1e+08 "
        "1e+09: 1; haze-march-steps 32",
        "lights [] 1 10 100 1000 3000: 1; same image; whole; assign tiled; assign every",
        "triangles [] 100 1000 1e+04 1e+05 1e+06: 1; whole",
        "size [pixels] 1 2 4 9 18 45 90 180 360 720: 36; whole",
        "time [s] 0 0.001 0.01 0.1 1 10 100 1000 1e+04 1e+05 1e+06: 0"};
    EXPECT_EQ(rows, expected);
}

// A quantity says what the scene lacks for it: of several, the first.
TEST(AuditQuantities, EachSaysWhatItLacks) {
    Subject still = oneTriangle(), bare = oneTriangle();
    bare.original.scene.lights.clear();
    bare.original.scene.materials.clear();
    bare.has_surface = false;
    bare.original.scene.meshes[0].primitives[0].joint_sets.emplace_back();
    Subject flat = bare;
    flat.view.camera.orthographic = true;
    flat.original.scene.lights = {lampAt(LightKind::rect, {}, 1)};
    Subject empty = bare;
    empty.bounds = {};
    std::vector<std::string> ofStill, ofBare, ofFlat;
    for (const Quantity& quantity : quantities()) {
        for (const auto& [subject, lacks] : {std::pair{&still, &ofStill}, {&bare, &ofBare}, {&flat, &ofFlat}})
            if (const std::string reason = quantity.lacks(*subject); !reason.empty())
                lacks->push_back(fmt::format("{}: {}", quantity.name, reason));
        EXPECT_EQ(quantity.lacks(empty), "the scene has nothing to draw") << quantity.name;
    }
    const std::string environment = "environment: the scene has no environment: add one with --env",
                      texel = "texel: no material has a texture",
                      time = "time: nothing in the scene is animated",
                      lamp = "the scene has no point, spot or area light",
                      sun = "the scene has no directional light",
                      rigid = "triangles: every mesh of the scene is skinned or morphed",
                      map = "normal_map: no material has a normal map",
                      flatCamera = "the camera is orthographic", unseen = "grazing: no surface is in view";
    EXPECT_EQ(ofStill, (std::vector{environment, texel, time}));
    EXPECT_EQ(ofBare,
              (std::vector{unseen, "range: " + lamp, "distance: " + lamp, "eye: " + lamp,
                           std::string("cone: the scene has no point or spot light"), environment, map, texel,
                           "shadow_depth: " + sun, "evsm_exponent: " + sun, "lights: " + lamp, rigid, time}));
    EXPECT_EQ(ofFlat,
              (std::vector{"fov: " + flatCamera, "grazing: " + flatCamera, "distance: " + flatCamera,
                           std::string("cone: the scene has no point or spot light"), environment, map, texel,
                           "shadow_depth: " + sun, "evsm_exponent: " + sun, rigid, time}));
    still.moves = true;
    EXPECT_EQ(quantityCalled("time").lacks(still), "");
    const std::string unknown = faultOf([] { quantitiesOf(std::array{std::string("gloss")}, "--require"); });
    EXPECT_TRUE(
        unknown.starts_with("--require gloss: there is no such quantity; there are offset, vertex, scale, "))
        << unknown;
}

// ---- Lights ----

TEST(AuditChanges, IntensityScalesEverythingThatShines) {
    Subject subject = oneTriangle();
    Scene& scene = subject.original.scene;
    scene.materials[1].emissive = {1, 2, 3};
    scene.materials[1].lightmap_intensity = 5;
    scene.material_parts[1].emissive_strength = 7;
    scene.background = {0.25f, 0.5f, 1};
    subject.original.settings.ambient = {1, 2, 3};
    subject.original.settings.ibl_intensity = 0.5f;
    subject.original.settings.light_cutoff = 0.125f;
    const Case changed = changedBy("intensity", subject, 4);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(changed.scene.lights[i].intensity, 4 * scene.lights[i].intensity) << i;
    EXPECT_EQ(changed.scene.materials[1].emissive, glm::vec3(4, 8, 12));
    EXPECT_EQ(changed.scene.materials[1].lightmap_intensity, 20);
    EXPECT_EQ(changed.scene.material_parts.at(1).emissive_strength, 28);
    EXPECT_EQ(changed.scene.background, glm::vec3(1, 2, 4));
    EXPECT_EQ(changed.settings.ambient, (Rgb{4, 8, 12}));
    EXPECT_EQ(changed.settings.ibl_intensity, 2);
    EXPECT_EQ(changed.settings.light_cutoff, 0.5f);
}

TEST(AuditChanges, ARangeIsOfLocalLights) {
    Subject subject = oneTriangle();
    const Case changed = changedBy("range", subject, 3);
    EXPECT_TRUE(std::isinf(changed.scene.lights[0].range)) << "the sun has none";
    for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(changed.scene.lights[i].range, 3);
    // Without one, all of the scene is reached.
    for (Light& light : subject.original.scene.lights) light.range = std::numeric_limits<float>::infinity();
    EXPECT_DOUBLE_EQ(quantityCalled("range").original(subject), 12);
}

// A light moves straight to its distance. As a light of the surface it is as bright there; an area light,
// whose size is not scaled, keeps its radiance.
TEST(AuditChanges, LocalLightsMoveStraightToTheirDistance) {
    const Subject subject = oneTriangle();
    const Case nearer = changedBy("distance", subject, 1), beside = changedBy("eye", subject, 1),
               at = changedBy("distance", subject, 0);
    const std::vector<Light>&before = subject.original.scene.lights, &surface = nearer.scene.lights,
          &eye = beside.scene.lights;
    EXPECT_EQ(surface[0].intensity, 2);
    EXPECT_EQ(surface[1].position, glm::dvec3(0, 1, -8));
    EXPECT_EQ(surface[1].intensity, 0.5f) << "a quarter of the distance";
    EXPECT_TRUE(std::isinf(surface[1].range));
    EXPECT_NEAR(glm::distance(surface[2].position, glm::dvec3(0.6, 0, -7.2)), 0, 1e-12) << "3, 0, 4 of 5 m";
    EXPECT_FLOAT_EQ(surface[2].intensity, 4.0f / 25);
    EXPECT_EQ(surface[3].position, glm::dvec3(0, 0, -7));
    EXPECT_EQ(surface[3].intensity, 16);
    EXPECT_TRUE(std::isinf(surface[3].range));
    EXPECT_NEAR(glm::distance(eye[2].position, glm::dvec3(0.6, 0, -0.8)), 0, 1e-12);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(eye[i].intensity, before[i].intensity) << "as it shines on surfaces";
        EXPECT_EQ(eye[i].range, before[i].range);
        EXPECT_EQ(at.scene.lights[i].intensity, before[i].intensity) << "not dark at 0 m";
    }
    EXPECT_EQ(at.scene.lights[1].position, subject.point);
}

TEST(AuditChanges, AConeIsOfPointAndSpotLights) {
    const Subject subject = oneTriangle();
    const Case changed = changedBy("cone", subject, 60);
    const std::vector<Light>& lights = changed.scene.lights;
    EXPECT_EQ(lights[0].kind, LightKind::directional);
    EXPECT_EQ(lights[3].kind, LightKind::rect);
    for (const std::size_t i : {1u, 2u}) {
        EXPECT_EQ(lights[i].kind, LightKind::spot);
        EXPECT_FLOAT_EQ(lights[i].outer_cone, glm::radians(30.0f));
        EXPECT_EQ(lights[i].inner_cone, lights[i].outer_cone);
    }
    EXPECT_EQ(lights[1].direction, glm::dvec3(0, -1, 0)) << "to the point in the middle";
    EXPECT_NEAR(glm::distance(lights[2].direction, glm::dvec3(-0.6, 0, -0.8)), 0, 1e-15);
}

// Only the pixel with the largest sum; its components end with float32.
TEST(AuditChanges, AnEnvironmentsBrightestPixelIsScaled) {
    Subject subject = oneTriangle();
    subject.original.scene.environment.emplace().radiance = Image(3, 1, 3);
    auto& data = subject.original.scene.environment->radiance.data;
    data = {9, 0, 0, 3, 4, 5, 6, 0, 6};
    EXPECT_EQ(changedBy("environment", subject, 10).scene.environment->radiance.data,
              (decltype(Image::data){9, 0, 0, 30, 40, 50, 6, 0, 6}));
    const float end = std::numeric_limits<float>::max();
    data[4] = 1e30f;
    EXPECT_EQ(changedBy("environment", subject, 1e12).scene.environment->radiance.data[4], end);
}

// Copies share a light's intensity. 3000 copies of three lights times the pixels are at most 1e8.
TEST(AuditChanges, CopiesOfLightsShareItsIntensity) {
    Subject subject = oneTriangle();
    Case changed = changedBy("lights", subject, 3);
    ASSERT_EQ(changed.scene.lights.size(), 10u);
    const auto at = [&](std::size_t i) {
        return std::pair(changed.scene.lights[i].kind, changed.scene.lights[i].intensity);
    };
    EXPECT_EQ(at(0), std::pair(LightKind::directional, 2.0f));
    for (const auto& [i, kind, intensity] :
         {std::tuple{1u, LightKind::point, 8.0f}, {4u, LightKind::spot, 4.0f}, {7u, LightKind::rect, 16.0f}})
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(at(i + k), std::pair(kind, intensity / 3));
    EXPECT_EQ(changed.settings.size, (Size{64, 36})) << "2304 pixels";
    subject.original.settings.size = {400, 200};
    const double part = std::sqrt(1e8 / (3000.0 * 3 * 400 * 200));
    changed = changedBy("lights", subject, 1);
    EXPECT_EQ(changed.settings.size,
              (Size{static_cast<int>(std::lround(400 * part)), static_cast<int>(std::lround(200 * part))}))
        << "of any number of copies";
}

// ---- Surfaces ----

TEST(AuditChanges, MaterialsAndTexelsAreSet) {
    Subject subject = oneTriangle();
    Scene& scene = subject.original.scene;
    scene.material_parts[0].emissive_strength = 3;
    scene.images.resize(3);
    scene.images[0].rgba.assign(8, 9);
    scene.images[1].rgba16.assign(4, 9);
    scene.images[2].rgba32.assign(4, 9);
    scene.images[2].largest = 5;
    for (const Material& material : changedBy("roughness", subject, 0.25).scene.materials)
        EXPECT_EQ(material.roughness, 0.25f);
    const Case mapped = changedBy("normal_map", subject, 8);
    EXPECT_EQ(mapped.scene.materials[0].normal_scale, 8);
    EXPECT_EQ(mapped.scene.materials[1].normal_scale, 1) << "it has no normal map";
    const Case sends = changedBy("emission", subject, 1e39), faint = changedBy("emission", subject, 0.5);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(sends.scene.materials[i].emissive, glm::vec3(std::numeric_limits<float>::max()));
        EXPECT_EQ(faint.scene.materials[i].emissive, glm::vec3(0.5f));
    }
    EXPECT_EQ(faint.scene.material_parts.at(0).emissive, glm::dvec3(1));
    EXPECT_EQ(faint.scene.material_parts.at(0).emissive_strength, 0.5);
    EXPECT_EQ(changedBy("color", subject, 0.25).scene.meshes[0].primitives[0].colors,
              std::vector<glm::vec4>(3, {0.25f, 0.25f, 0.25f, 1}));
    const Case texels = changedBy("texel", subject, 0.4);
    EXPECT_EQ(texels.scene.images[0].rgba, (std::vector<std::uint8_t>{102, 102, 102, 9, 102, 102, 102, 9}));
    EXPECT_EQ(texels.scene.images[1].rgba16, (std::vector<std::uint16_t>{26214, 26214, 26214, 9}));
    EXPECT_EQ(texels.scene.images[2].rgba32, (std::vector<float>{2, 2, 2, 9})) << "of the largest, 5";
}

// Beyond the scene's sphere towards the sun, half a radius beside it, a thousandth of it large.
TEST(AuditChanges, ACasterStandsTowardsTheSun) {
    Subject subject = oneTriangle();
    for (const auto& [sun, beside] : {std::pair{glm::dvec3(0, -2, 0), glm::dvec3(0, 0, -1)},
                                      {glm::dvec3(-2, 0, 0), glm::dvec3(0, 0, 1)}}) {
        subject.original.scene.lights[0].direction = sun;
        subject.original.settings.shadows = Shadows::off;
        const Case changed = changedBy("shadow_depth", subject, 10);
        EXPECT_EQ(changed.settings.shadows, Shadows::pcf);
        const Scene& scene = changed.scene;
        ASSERT_EQ(scene.nodes.size(), 3u);
        EXPECT_EQ(scene.nodes[2].mesh, 1);
        const glm::dvec3 up = -glm::normalize(sun), at(scene.nodes[2].parent_from_node[3]);
        EXPECT_NEAR(glm::distance(at, glm::dvec3(0, 0, -8) + 16.0 * up + 3.0 * beside), 0, 1e-12)
            << at.x << " " << at.y << " " << at.z;
        const Primitive& triangle = scene.meshes.at(1).primitives.at(0);
        EXPECT_EQ(triangle.positions.size(), 3u);
        EXPECT_NEAR(glm::distance(triangle.positions[0], triangle.positions[1]), 6e-3, 1e-8);
        EXPECT_NEAR(glm::distance(triangle.positions[0], triangle.positions[2]), 6e-3, 1e-8);
        const glm::vec3 front = glm::normalize(glm::cross(triangle.positions[1], triangle.positions[2]));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(triangle.normals[i], glm::vec3(up));
        EXPECT_NEAR(glm::dot(front, glm::vec3(up)), 1, 1e-6) << "its front is towards the sun";
        EXPECT_EQ(triangle.material, 2);
        EXPECT_EQ(scene.materials.at(2).base_color, glm::vec4(0, 0, 0, 1));
        subject.original.settings.shadows = Shadows::msm4;
        EXPECT_EQ(changedBy("shadow_depth", subject, 10).settings.shadows, Shadows::msm4);
    }
}

TEST(AuditChanges, SettingsAreSet) {
    Subject subject = oneTriangle();
    for (const auto& [own, used] : {std::pair{Shadows::pcf, Shadows::evsm},
                                    {Shadows::evsm, Shadows::evsm},
                                    {Shadows::evsm4, Shadows::evsm4}}) {
        subject.original.settings.shadows = own;
        const Settings settings = changedBy("evsm_exponent", subject, 20).settings;
        EXPECT_EQ(settings.shadows, used);
        EXPECT_EQ(settings.evsm_exponent, 20);
        EXPECT_EQ(settings.evsm_precision, EvsmPrecision::fp32);
    }
    EXPECT_TRUE(changedBy("haze", subject, 0.5).settings.haze);
    EXPECT_EQ(changedBy("haze", subject, 0.5).settings.haze_density, 0.5f);
    EXPECT_EQ(changedBy("time", subject, 2.5).settings.time, 2.5);
    EXPECT_EQ(changedBy("exposure", subject, 2.5).exposure, 2.5);
    for (const auto& [height, size] :
         {std::pair{90.0, Size{160, 90}}, {9.0, Size{16, 9}}, {1.0, Size{2, 1}}, {0.2, Size{1, 1}}})
        EXPECT_EQ(changedBy("size", subject, height).settings.size, size) << height;
}

// n x n similar triangles for each, n the root of how many times more there are to be.
TEST(AuditChanges, TrianglesAreDividedEvenly) {
    const Subject subject = oneTriangle();
    EXPECT_EQ(changedBy("triangles", subject, 2).scene.meshes[0].primitives[0].indices.size(), 3u)
        << "1.41 is 1";
    const Case two = changedBy("triangles", subject, 4);
    const Primitive& parts = two.scene.meshes[0].primitives[0];
    EXPECT_EQ(parts.positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {4, 0, 0}, {2, 2, 0}, {0, 4, 0}}));
    EXPECT_EQ(parts.indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 4, 1, 4, 2, 2, 4, 5}));
    EXPECT_EQ(parts.normals, std::vector<glm::vec3>(6, {0, 0, 1}));
    EXPECT_EQ(parts.tangents, std::vector<glm::vec4>(6, {1, 0, 0, -1}));
    EXPECT_EQ(changedBy("triangles", subject, 9).scene.meshes[0].primitives[0].indices.size(), 27u);
}

// ---- Places and the camera ----

// Vertices move by 0.8, 0, 0.6 of the distance, their node back.
TEST(AuditChanges, VerticesMoveAndTheirNodeBack) {
    Subject subject = oneTriangle();
    Scene& scene = subject.original.scene;
    scene.nodes.push_back({.name = "copied", .mesh = 0, .copies = 0});
    scene.copies = {{glm::dmat4(2)}};
    const Case changed = changedBy("vertex", subject, 10);
    EXPECT_EQ(changed.scene.meshes[0].primitives[0].positions,
              (std::vector<glm::vec3>{{8, 0, 6}, {12, 0, 6}, {8, 4, 6}}));
    ASSERT_EQ(changed.scene.nodes.size(), 4u);
    EXPECT_EQ(changed.scene.nodes[1].mesh, -1);
    EXPECT_EQ(changed.scene.nodes[2].mesh, 0) << "its copies move back";
    EXPECT_EQ(changed.scene.nodes[3].mesh, 0);
    EXPECT_EQ(changed.scene.nodes[3].parent, 1);
    EXPECT_EQ(glm::dvec3(changed.scene.nodes[3].parent_from_node[3]), glm::dvec3(-8, 0, -6));
    EXPECT_EQ(glm::dvec3(changed.scene.copies[0][0][3]), glm::dvec3(-16, 0, -12));
    scene.meshes[0].primitives[0].joint_sets.emplace_back();
    EXPECT_EQ(changedBy("vertex", subject, 10).scene.meshes[0].primitives[0].positions[0], glm::vec3(0))
        << "joints place them";
}

// All lengths times the factor: candela times its square, haze as many times thinner.
TEST(AuditChanges, AScaleIsOfAllLengths) {
    Subject subject = oneTriangle();
    Case& original = subject.original;
    original.camera().far = 50;
    original.camera().ymag = 3;
    original.scene.materials[0].attenuation_distance = 7;
    Light& area = original.scene.lights[3];
    area.width = 2, area.height = 3, area.radius = 5, area.length = 7, area.range = 11;
    original.settings.haze = true;
    original.settings.haze_density = 8;
    original.settings.haze_ground = 3;
    original.settings.shadow_distance = 5;
    const Case changed = changedBy("scale", subject, 2);
    const std::vector<Light>& lights = changed.scene.lights;
    EXPECT_EQ(lights[3].width, 4);
    EXPECT_EQ(lights[3].height, 6);
    EXPECT_EQ(lights[3].radius, 10);
    EXPECT_EQ(lights[3].length, 14);
    EXPECT_EQ(lights[3].range, 22);
    EXPECT_EQ(lights[3].position, glm::dvec3(0, 0, -12));
    for (const auto& [i, intensity] : {std::pair{0u, 2.0f}, {1u, 32.0f}, {2u, 16.0f}, {3u, 16.0f}})
        EXPECT_EQ(lights[i].intensity, intensity) << i;
    EXPECT_EQ(changed.scene.materials[0].attenuation_distance, 14);
    EXPECT_EQ(changed.camera().near, 0.2);
    EXPECT_EQ(changed.camera().far, 100);
    EXPECT_EQ(changed.camera().ymag, 6);
    EXPECT_EQ(changed.settings.haze_density, 4);
    EXPECT_EQ(changed.settings.haze_rayleigh_height, 2 * original.settings.haze_rayleigh_height);
    EXPECT_EQ(changed.settings.haze_mie_height, 2 * original.settings.haze_mie_height);
    EXPECT_EQ(changed.settings.haze_ground, 6);
    EXPECT_EQ(changed.settings.shadow_distance, 10);
    ASSERT_EQ(changed.scene.nodes.size(), 3u);
    EXPECT_EQ(changed.scene.nodes[0].parent, 2) << "below a node that scales";
    EXPECT_EQ(changed.scene.nodes[1].parent, 0);
    EXPECT_EQ(changed.scene.nodes[2].parent_from_node,
              glm::dmat4(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 2, 0, 0), glm::dvec4(0, 0, 2, 0),
                         glm::dvec4(0, 0, 0, 1)));
    original.settings.haze = false;
    EXPECT_EQ(changedBy("scale", subject, 2).settings.haze_density, 8) << "without haze, as it was";
}

TEST(AuditChanges, ACamerasPlanesAndAngles) {
    Subject subject = oneTriangle();
    // Without a far plane it is at twice the distance of the farthest surface, 8 + 6 m.
    Case changed = changedBy("near", subject, 100);
    EXPECT_DOUBLE_EQ(changed.camera().far, 28);
    EXPECT_DOUBLE_EQ(changed.camera().near, 0.28);
    subject.view.camera.far = 50;
    changed = changedBy("near", subject, 1000);
    EXPECT_DOUBLE_EQ(changed.camera().far, 50);
    EXPECT_DOUBLE_EQ(changed.camera().near, 0.05);
    EXPECT_DOUBLE_EQ(changedBy("fov", subject, 90).camera().yfov, glm::radians(90.0));
    // The eye turns about the point, towards where it is; from straight above, towards a side.
    for (const auto& [normal, eye] : {std::pair{glm::dvec3(0, 0.6, 0.8), glm::dvec3(0, -0.8, 0.6)},
                                      {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0)},
                                      {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}}) {
        subject.normal = normal;
        const double angle = glm::radians(30.0);
        const glm::dvec3 expected = subject.point + 8.0 * (std::cos(angle) * eye + std::sin(angle) * normal);
        const glm::dmat4 camera = changedBy("grazing", subject, 30).camera().world_from_camera;
        EXPECT_NEAR(glm::distance(glm::dvec3(camera[3]), expected), 0, 1e-12)
            << normal.y << " " << normal.z << ": " << camera[3].x << " " << camera[3].y << " " << camera[3].z;
        EXPECT_EQ(camera, lookAt(glm::dvec3(camera[3]), subject.point));
        EXPECT_NEAR(quantityCalled("grazing").original(subject), glm::degrees(std::asin(normal.z)), 1e-12);
    }
    subject.normal = {0, 0, -1};
    EXPECT_EQ(quantityCalled("grazing").original(subject), 0);
}

}  // namespace diptych::audit
