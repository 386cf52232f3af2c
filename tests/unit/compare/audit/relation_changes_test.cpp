// SPDX-License-Identifier: MIT
// What each metamorphic relation is, and what it changes, exactly.
#include "compare/audit/relations.h"
#include "compare/audit/small_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace diptych::audit {

namespace {

// A mesh of three triangles, of which the second is not flat, and a blended one; another mesh of twice these
// three. A node for each, and two lights.
Subject fourTriangles() {
    Subject subject;
    subject.bounds = {{-1, -1, -5}, {1, 1, -3}};
    subject.has_surface = true;
    subject.point = {0, 0, -3};
    subject.normal = {0, 0, 1};
    subject.nearest = 2;
    subject.view.width = 32;
    subject.view.height = 18;
    subject.original.settings.size = {32, 18};
    subject.original.settings.shadows = Shadows::off;
    Scene& scene = subject.original.scene;
    Primitive solid, glass;
    solid.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {4, 0, 0}, {4, 2, 0}, {6, 0, 0}};
    solid.normals.assign(7, {0, 0, 1});
    solid.normals[5] = {0, 1, 0};
    solid.tangents.assign(7, {1, 0, 0, 1});
    solid.indices = {0, 1, 2, 3, 4, 5, 4, 6, 3};
    solid.material = 0;
    glass.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    glass.normals.assign(3, {0, 0, 1});
    glass.tangents.assign(3, {1, 0, 0, 1});
    glass.indices = {0, 1, 2};
    glass.material = 2;
    scene.meshes = {{"both", {solid, glass}}, {"solid", {solid, solid}}};
    scene.meshes[1].primitives[1].material = 1;
    scene.nodes = {{.name = "a", .mesh = 0}, {.name = "b", .parent = 0, .mesh = 1}};
    scene.materials.resize(3);
    scene.materials[2].alpha_mode = AlphaMode::blend;
    scene.material_parts[0].emissive_strength = 7;
    Light sun, lamp;
    sun.kind = LightKind::directional;
    sun.direction = {0, -1, 0};
    sun.intensity = 2;
    lamp.position = {1, 2, 3};
    lamp.intensity = 8;
    lamp.range = 4;
    scene.lights = {sun, lamp};
    scene.cameras.push_back(subject.view.camera);
    return subject;
}

const Relation& relationCalled(const std::string& name) {
    return *relationsOf(std::array{name}).front();
}
Related relatedBy(const std::string& name, const Subject& subject) {
    Related both{subject.original, subject.original};
    relationCalled(name).change(both, subject);
    return both;
}

}  // namespace

TEST(RelationTable, ItsRowsAreThese) {
    std::vector<std::string> rows;
    for (const Relation& relation : relations())
        rows.push_back(fmt::format(
            "{}: {}{}{}{}", relation.name, nameOf(relation.equality), relation.reorders ? ", reorders" : "",
            relation.same_pipelines ? ", same pipelines" : "", relation.of_settings ? ", of settings" : ""));
    const std::vector<std::string> expected{"lights_permuted: sums",
                                            "lights_split: sums",
                                            "light_doubled: bits, same pipelines",
                                            "light_64th: bits, same pipelines",
                                            "dark_lights: bits",
                                            "far_lights: bits",
                                            "moved: rounding",
                                            "turned: rounding",
                                            "quarter_turn: rounding",
                                            "mirrored: rounding",
                                            "scaled: bits, same pipelines",
                                            "tiles_shifted: rounding",
                                            "near_halved: bits, same pipelines",
                                            "draws_reversed: bits, reorders, same pipelines",
                                            "meshes_split: bits, reorders, same pipelines",
                                            "unindexed: bits, same pipelines",
                                            "triangles_split: rounding",
                                            "materials_permuted: bits, reorders, same pipelines",
                                            "through_gltf: rounding",
                                            "through_glb: bits, same pipelines",
                                            "repeated: bits, same pipelines",
                                            "assign_every: bits, of settings",
                                            "assign_tiled: bits, of settings",
                                            "light_kernel: bits, of settings",
                                            "prepass: bits, of settings",
                                            "cull: bits, same pipelines, of settings",
                                            "lighting: bits, of settings",
                                            "still_time: bits, same pipelines"};
    EXPECT_EQ(rows, expected);
}

// Each condition makes some relations inapplicable, and the reason is said.
TEST(RelationTable, WhatMakesWhichInapplicable) {
    const std::string shadows = "shadow-map texels fall on other points: leave out --shadows",
                      perObject =
                          "--assign per_object merges some of an object's lights, and then merges others";
    struct Condition {
        const char* name;
        void (*make)(Subject&);
        std::vector<std::string> lacks;
    };
    const Condition conditions[] = {
        {"nothing", [](Subject&) {}, {}},
        {"shadows",
         [](Subject& s) { s.original.settings.shadows = Shadows::pcf; },
         {"lights_split: a sun or --shadow-lights cast shadows: leave out --shadows", "moved: " + shadows,
          "turned: " + shadows, "quarter_turn: " + shadows, "mirrored: " + shadows, "scaled: " + shadows,
          "tiles_shifted: " + shadows, "near_halved: " + shadows}},
        {"shadow lights",
         [](Subject& s) { s.original.settings.shadow_lights = 1; },
         {"lights_permuted: --shadow-lights selects among equal lights by their order"}},
        {"one light",
         [](Subject& s) { s.original.scene.lights.pop_back(); },
         {"lights_permuted: the scene has one light"}},
        {"no light",
         [](Subject& s) { s.original.scene.lights.clear(); },
         {"lights_permuted: the scene has one light", "lights_split: the scene has no light"}},
        {"cutoff",
         [](Subject& s) { s.original.settings.light_cutoff = 0.01f; },
         {"lights_split: --light-cutoff gives a dimmer light a shorter range"}},
        {"haze", [](Subject& s) { s.original.settings.haze = true; }, {}},
        {"haze and two suns",
         [](Subject& s) {
             s.original.settings.haze = true;
             s.original.scene.lights[1].kind = LightKind::directional;
         },
         {"lights_permuted: --haze scatters the light of one sun"}},
        {"per object",
         [](Subject& s) { s.original.settings.assign = Assignment::per_object; },
         {"lights_permuted: " + perObject, "lights_split: " + perObject, "dark_lights: " + perObject,
          "far_lights: " + perObject, "turned: " + perObject, "quarter_turn: " + perObject,
          "mirrored: " + perObject, "triangles_split: " + perObject, "assign_every: " + perObject,
          "assign_tiled: " + perObject, "light_kernel: " + perObject}},
        {"every light",
         [](Subject& s) { s.original.settings.assign = Assignment::every; },
         {"light_kernel: --assign every has no lists"}},
        {"environment",
         [](Subject& s) { s.original.scene.environment.emplace(); },
         {"turned: the maps of an environment have their own pixel grid",
          "quarter_turn: the maps of an environment have their own pixel grid",
          "mirrored: the maps of an environment have their own pixel grid"}},
        {"odd width",
         [](Subject& s) { s.view.width = 31; },
         {"mirrored: the picture's width is odd: mirrored, derivatives would use other 2x2 quads"}},
        {"transmission",
         [](Subject& s) { s.original.scene.materials[1].transmission = 0.5f; },
         {"tiles_shifted: surfaces with transmission read the picture up to its border, which moves"}},
        {"orthographic",
         [](Subject& s) { s.view.camera.orthographic = true; },
         {"near_halved: the camera is orthographic"}},
        {"unsorted",
         [](Subject& s) { s.original.settings.transparency = Transparency::unsorted; },
         {"draws_reversed: --transparency unsorted blends in file order"}},
        {"a skin on each mesh",
         [](Subject& s) {
             for (Mesh& mesh : s.original.scene.meshes) mesh.primitives[0].joint_sets.emplace_back();
         },
         {"draws_reversed: every mesh of the scene is skinned or morphed",
          "meshes_split: every mesh of the scene is skinned or morphed",
          "unindexed: every mesh of the scene is skinned or morphed"}},
        {"far away",
         [](Subject& s) { s.nearest = s.bounds.radius() / 1001; },
         {"triangles_split: the scene's farthest surface is over 1000 times as far as its nearest: rounded "
          "edge "
          "midpoints would be visible"}},
        {"just near enough", [](Subject& s) { s.nearest = s.bounds.radius() / 999; }, {}},
        {"not flat",
         [](Subject& s) {
             for (Mesh& mesh : s.original.scene.meshes)
                 for (Primitive& primitive : mesh.primitives)
                     for (std::size_t i = 0; i < primitive.tangents.size(); ++i)
                         primitive.tangents[i].x = static_cast<float>(i);
         },
         {"triangles_split: the scene has no flat triangle outside skinned and morphed meshes"}},
        {"one material",
         [](Subject& s) {
             s.original.scene.materials.resize(1);
             for (Mesh& mesh : s.original.scene.meshes)
                 for (Primitive& primitive : mesh.primitives) primitive.material = 0;
         },
         {"materials_permuted: the scene has one material"}},
        {"an animation of a material",
         [](Subject& s) {
             s.original.scene.animations.resize(1);
             s.original.scene.animations[0].channels.resize(1);
             s.original.scene.animations[0].channels[0].part = AnimatedPart::base_color;
         },
         {"materials_permuted: an animation refers to a material by its index"}},
        {"motion", [](Subject& s) { s.moves = true; }, {"still_time: something in the scene is animated"}},
    };
    for (const auto& [name, make, expected] : conditions) {
        Subject subject = fourTriangles();
        make(subject);
        std::vector<std::string> lacks;
        for (const Relation& relation : relations()) {
            if (relation.name.starts_with("through_")) continue;  // it poses the scene
            if (const std::string reason = relation.lacks(subject); !reason.empty())
                lacks.push_back(fmt::format("{}: {}", relation.name, reason));
        }
        EXPECT_EQ(lacks, expected) << name;
    }
}

// ---- Lights ----

TEST(RelationChanges, LightsAreSplitAndMultiplied) {
    Subject subject = fourTriangles();
    const auto intensities = [&](const std::string& name) {
        std::vector<float> all;
        for (const Light& light : relatedBy(name, subject).changed.scene.lights)
            all.push_back(light.intensity);
        return all;
    };
    using Intensities = std::vector<float>;
    EXPECT_EQ(intensities("lights_split"), (Intensities{1, 1, 4, 4}));
    EXPECT_EQ(intensities("lights_permuted"), (Intensities{8, 2}));
    EXPECT_EQ(intensities("light_doubled"), (Intensities{4, 16}));
    EXPECT_EQ(intensities("light_64th"), (Intensities{1 / 32.0f, 1 / 8.0f}));
    EXPECT_EQ(relatedBy("light_doubled", subject).map.light, 2);
    EXPECT_EQ(relatedBy("light_64th", subject).map.light, 1 / 64.0);
    subject.original.settings.haze = true;
    EXPECT_EQ(intensities("lights_split"), (Intensities{2, 4, 4})) << "haze scatters one sun's light";
    // Unlit materials emit what no factor changes, so they become lit in both.
    EXPECT_FALSE(relatedBy("light_doubled", subject).own_base);
    subject.original.scene.materials[1].unlit = true;
    const Related doubled = relatedBy("light_doubled", subject);
    EXPECT_TRUE(doubled.own_base);
    EXPECT_FALSE(doubled.base.scene.materials[1].unlit);
    EXPECT_FALSE(doubled.changed.scene.materials[1].unlit);
}

TEST(RelationChanges, DarkAndFarLightsAreAdded) {
    Subject subject = fourTriangles();
    const std::vector<Light> dark = relatedBy("dark_lights", subject).changed.scene.lights,
                             far = relatedBy("far_lights", subject).changed.scene.lights;
    ASSERT_EQ(dark.size(), 4u);
    for (const std::size_t i : {0u, 3u}) {
        EXPECT_EQ(dark[i].intensity, 0);
        EXPECT_EQ(dark[i].position, glm::dvec3(0, 0, -2.9)) << "a twentieth of 2 m before the surface";
        EXPECT_EQ(dark[i].kind, i == 0 ? LightKind::point : LightKind::spot);
    }
    EXPECT_EQ(dark[3].direction, glm::dvec3(0, 0, -1)) << "at the surface";
    subject.has_surface = false;
    EXPECT_EQ(relatedBy("dark_lights", subject).changed.scene.lights[0].position, glm::dvec3(0, 0, -3.9));
    ASSERT_EQ(far.size(), 5u);
    const double away = 4 * std::sqrt(3.0) + 16;  // the box's radius
    for (const auto& [i, along] :
         {std::pair{0u, glm::dvec3(0, 0, -1)}, {1u, glm::dvec3(0, 1, 0)}, {2u, glm::dvec3(1, 0, 0)}}) {
        EXPECT_NEAR(glm::distance(far[i].position, glm::dvec3(0, 0, -4) + away * along), 0, 1e-12) << i;
        EXPECT_EQ(far[i].intensity, 1e6f);
        EXPECT_EQ(far[i].range, 1);
    }
}

// ---- Geometry ----

TEST(RelationChanges, DrawsAreReversedButForBlendedMeshes) {
    const Scene scene = relatedBy("draws_reversed", fourTriangles()).changed.scene;
    ASSERT_EQ(scene.nodes.size(), 3u);
    EXPECT_EQ(scene.nodes[0].mesh, 0) << "blended triangles keep their order";
    EXPECT_EQ(scene.nodes[1].mesh, -1);
    EXPECT_EQ(scene.nodes[2].mesh, 1);
    EXPECT_EQ(scene.nodes[2].parent, 1);
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 0);
    EXPECT_EQ(scene.meshes[1].primitives[0].material, 1);
    EXPECT_EQ(scene.meshes[1].primitives[1].material, 0);
    // Of two, the last comes first.
    Subject two = fourTriangles();
    two.original.scene.nodes[0].mesh = 1;
    const std::vector<Node> nodes = relatedBy("draws_reversed", two).changed.scene.nodes;
    ASSERT_EQ(nodes.size(), 4u);
    EXPECT_EQ(nodes[2].parent, 1);
    EXPECT_EQ(nodes[3].parent, 0);
}

TEST(RelationChanges, MeshesAreSplitInHalves) {
    using Indices = std::vector<std::uint32_t>;
    Subject subject = fourTriangles();
    const Scene scene = relatedBy("meshes_split", subject).changed.scene;
    ASSERT_EQ(scene.meshes.size(), 4u);
    EXPECT_EQ(scene.meshes[0].primitives.at(0).indices, (Indices{0, 1, 2})) << "one of three";
    EXPECT_EQ(scene.meshes[0].primitives.at(1).indices, (Indices{0, 1, 2}))
        << "blended triangles stay together";
    ASSERT_EQ(scene.meshes[2].primitives.size(), 1u);
    EXPECT_EQ(scene.meshes[2].primitives[0].indices, (Indices{3, 4, 5, 4, 6, 3}));
    ASSERT_EQ(scene.nodes.size(), 4u);
    EXPECT_EQ(scene.nodes[0].mesh, 0);
    EXPECT_EQ(scene.nodes[2].mesh, 2);
    EXPECT_EQ(scene.nodes[2].parent, 0);
    EXPECT_EQ(scene.nodes[3].mesh, 3);
    EXPECT_EQ(scene.nodes[3].parent, 1);
    subject.original.scene.meshes[0].primitives.erase(subject.original.scene.meshes[0].primitives.begin());
    EXPECT_EQ(relatedBy("meshes_split", subject).changed.scene.meshes.size(), 3u)
        << "only one has two halves";
    subject.original.scene.meshes[1].primitives[1].targets.emplace_back();
    EXPECT_EQ(relatedBy("meshes_split", subject).changed.scene.meshes.size(), 2u) << "one is morphed";
}

TEST(RelationChanges, VerticesAreSeparated) {
    Subject subject = fourTriangles();
    Primitive& solid = subject.original.scene.meshes[0].primitives[0];
    solid.texcoords[1].assign(7, {0.5f, 0.25f});
    solid.colors.assign(7, glm::vec4(0.5f));
    solid.flat = true;
    const Primitive parts = relatedBy("unindexed", subject).changed.scene.meshes[0].primitives[0];
    EXPECT_EQ(parts.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    ASSERT_EQ(parts.positions.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(parts.positions[i], solid.positions[solid.indices[i]]);
        EXPECT_EQ(parts.normals[i], solid.normals[solid.indices[i]]);
    }
    EXPECT_EQ(parts.tangents.size(), 9u);
    EXPECT_EQ(parts.texcoords[0].size(), 0u);
    EXPECT_EQ(parts.texcoords[1].size(), 9u);
    EXPECT_EQ(parts.colors.size(), 9u);
    EXPECT_TRUE(parts.flat);
    EXPECT_EQ(relatedBy("unindexed", subject).changed.scene.meshes[0].primitives[1].material, 2);
}

TEST(RelationChanges, FlatTrianglesBecomeFour) {
    const Primitive parts =
        relatedBy("triangles_split", fourTriangles()).changed.scene.meshes[0].primitives[0];
    EXPECT_EQ(parts.indices, (std::vector<std::uint32_t>{0, 7, 9,  7,  1,  8, 9,  8,  2,  7, 8,  9,  3, 4,
                                                         5, 4, 10, 12, 10, 6, 11, 12, 11, 3, 10, 11, 12}));
    ASSERT_EQ(parts.positions.size(), 13u);
    EXPECT_EQ(std::vector(parts.positions.begin() + 7, parts.positions.end()),
              (std::vector<glm::vec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {4, 1, 0}, {3, 1, 0}}));
    EXPECT_EQ(parts.normals[12], glm::vec3(0, 0, 1));
    EXPECT_EQ(parts.tangents[12], glm::vec4(1, 0, 0, 1));
}

TEST(RelationChanges, MaterialsAreReversed) {
    const Related permuted = relatedBy("materials_permuted", fourTriangles());
    const Scene& scene = permuted.changed.scene;
    EXPECT_EQ(permuted.map.ids, (std::vector<int>{2, 1, 0}));
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 2);
    EXPECT_EQ(scene.meshes[0].primitives[1].material, 0);
    EXPECT_EQ(scene.meshes[1].primitives[1].material, 1);
    ASSERT_EQ(scene.material_parts.size(), 1u);
    EXPECT_EQ(scene.material_parts.at(2).emissive_strength, 7);
}

// ---- Places, the camera and Settings ----

TEST(RelationChanges, AllIsTurnedAndMirrored) {
    Subject subject = fourTriangles();
    subject.original.scene.lights[1].axis = {1, 0, 0};
    const auto turnedBy = [&](const std::string& name, const glm::dmat3& rotation) {
        const Related turned = relatedBy(name, subject);
        const Case& changed = turned.changed;
        const auto near = [&](const glm::dvec3& a, const glm::dvec3& b) {
            return glm::distance(a, b) < 1e-12;
        };
        EXPECT_EQ(turned.map.rotation, rotation) << name;
        EXPECT_TRUE(near(changed.scene.lights[1].position, rotation * glm::dvec3(1, 2, 3))) << name;
        EXPECT_TRUE(near(changed.scene.lights[0].direction, rotation * glm::dvec3(0, -1, 0))) << name;
        EXPECT_TRUE(near(changed.scene.lights[1].axis, rotation * glm::dvec3(1, 0, 0))) << name;
        ASSERT_EQ(changed.scene.nodes.size(), 3u) << name;
        EXPECT_EQ(glm::dmat3(changed.scene.nodes[2].parent_from_node), rotation) << name;
        EXPECT_EQ(changed.scene.nodes[0].parent, 2) << name;
        const glm::dmat4& camera = changed.camera().world_from_camera;
        const double mirrored = name == "mirrored" ? -1 : 1;  // a camera stays right-handed
        EXPECT_TRUE(near(glm::dvec3(camera[0]), mirrored * rotation[0])) << name;
        EXPECT_TRUE(near(glm::dvec3(camera[1]), rotation[1])) << name;
        EXPECT_TRUE(near(glm::dvec3(camera[2]), rotation[2])) << name;
        EXPECT_EQ(turned.map.mirrored, name == "mirrored");
        EXPECT_EQ(turned.own_base, name == "mirrored");
    };
    const double c = std::cos(glm::radians(37.0)), s = std::sin(glm::radians(37.0));
    const glm::dmat3 turned{glm::rotate(glm::dmat4(1), glm::radians(37.0), glm::dvec3(0, 1, 0))};
    EXPECT_NEAR(glm::distance(turned[0], glm::dvec3(c, 0, -s)), 0, 1e-12);
    turnedBy("turned", turned);
    turnedBy("quarter_turn", glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}));
    subject.original.scene.materials[0].normal_texture.texture = 3;
    turnedBy("mirrored", glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    const Related mirrored = relatedBy("mirrored", subject);
    for (const Case* of : {&mirrored.base, &mirrored.changed})
        EXPECT_EQ(of->scene.materials[0].normal_texture.texture, -1) << "without textures";
    const Related moved = relatedBy("moved", subject);
    const glm::dvec3 by = std::sqrt(3.0) * glm::dvec3(86421.3, 0, -50321.7);
    EXPECT_NEAR(glm::length(by), 1e5 * std::sqrt(3.0), 10);
    EXPECT_NEAR(glm::distance(moved.changed.scene.lights[1].position, by + glm::dvec3(1, 2, 3)), 0, 1e-9);
}

TEST(RelationChanges, ThePictureGetsABorder) {
    Subject subject = fourTriangles();
    subject.original.camera().yfov = 2 * std::atan(0.9);
    subject.original.camera().ymag = 9;
    const Related shifted = relatedBy("tiles_shifted", subject);
    EXPECT_EQ(shifted.map.border, 6);
    EXPECT_EQ(shifted.changed.settings.size, (Size{44, 30}));
    EXPECT_NEAR(std::tan(shifted.changed.camera().yfov / 2), 1.5, 1e-12) << "0.9 of 18 pixels, 1.5 of 30";
    EXPECT_DOUBLE_EQ(shifted.changed.camera().ymag, 15);
    subject.original.camera().far = 9;
    const Related halved = relatedBy("near_halved", subject);
    EXPECT_TRUE(halved.own_base);
    for (const Case* of : {&halved.base, &halved.changed}) EXPECT_TRUE(std::isinf(of->camera().far));
    EXPECT_EQ(halved.base.camera().near, 0.1);
    EXPECT_EQ(halved.changed.camera().near, 0.05);
    EXPECT_EQ(relatedBy("scaled", subject).map.length, 2);
}

TEST(RelationChanges, SettingsAreComparedInPairs) {
    Subject subject = fourTriangles();
    for (const auto& [name, option, base, changed] :
         {std::tuple{"light_kernel", "light-kernel", "scatter", "gather"},
          {"prepass", "prepass", "off", "on"},
          {"cull", "cull", "on", "off"},
          {"lighting", "lighting", "fragment", "compute"}}) {
        const Related both = relatedBy(name, subject);
        EXPECT_TRUE(both.own_base) << name;
        EXPECT_EQ(both.base.settings.valueOf(option), base);
        EXPECT_EQ(both.changed.settings.valueOf(option), changed);
    }
    using enum Assignment;
    for (const auto& [own, with_every, with_tiled] :
         {std::tuple{clustered, every, tiled}, {every, clustered, tiled}, {tiled, every, every}}) {
        subject.original.settings.assign = own;
        EXPECT_EQ(relatedBy("assign_every", subject).changed.settings.assign, with_every);
        EXPECT_EQ(relatedBy("assign_tiled", subject).changed.settings.assign, with_tiled);
    }
    subject.original.settings.time = 3;
    EXPECT_EQ(relatedBy("still_time", subject).changed.settings.time, 13);
    EXPECT_EQ(relatedBy("repeated", subject).changed.settings, subject.original.settings);
}

}  // namespace diptych::audit
