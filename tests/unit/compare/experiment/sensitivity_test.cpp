// SPDX-License-Identifier: MIT
// A sweep omits Settings without effect on the scene, and states why.
#include "compare/experiment/sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace diptych::experiment {
namespace {

Light lightOf(LightKind kind, float range = std::numeric_limits<float>::infinity(), float angle = 0) {
    Light light;
    light.kind = kind;
    light.range = range;
    light.angle = angle;
    return light;
}

SweepRows sensitiveTo(const std::vector<Light>& lights) {
    return sensitiveRows(makeSweepRows({}, defaultGrids({})), lights);
}

std::set<std::string> valuesOf(const SweepRows& sweep, std::string_view option) {
    std::set<std::string> values;
    for (const Settings& row : sweep.rows) values.insert(row.valueOf(option));
    return values;
}

// The first reason; `value` restricts it to that value.
std::string reasonOf(const SweepRows& sweep, const std::string& option, const std::string& value = {}) {
    for (const SweepSkip& skip : sweep.skips)
        if (skip.tried.size() == 2 && skip.tried[1].option == option &&
            (value.empty() || skip.tried[1].value == value))
            return skip.reason;
    return {};
}

TEST(ExperimentSensitivity, ASunAloneFeelsNoListsAndNoAreaLights) {
    const SweepRows sweep = sensitiveTo({lightOf(LightKind::directional)});
    EXPECT_EQ(valuesOf(sweep, "assign"), (std::set<std::string>{"clustered", "per_object"}));
    EXPECT_EQ(valuesOf(sweep, "light-cutoff").size(), 1u);
    EXPECT_EQ(valuesOf(sweep, "area-lights").size(), 1u);
    EXPECT_EQ(valuesOf(sweep, "shadow-lights").size(), 1u);
    EXPECT_FALSE(valuesOf(sweep, "shadows").contains("pcss"));
    EXPECT_GT(valuesOf(sweep, "shadows").size(), 4u);
    EXPECT_EQ(reasonOf(sweep, "assign", "tiled"), "no light has a position: every light reaches every pixel");
    EXPECT_EQ(reasonOf(sweep, "shadows"), "the sun has no angular size: pcss equals pcf");
}

TEST(ExperimentSensitivity, ASunWithADiscFeelsPcss) {
    EXPECT_TRUE(
        valuesOf(sensitiveTo({lightOf(LightKind::directional, 1, 0.01f)}), "shadows").contains("pcss"));
}

TEST(ExperimentSensitivity, TheCutoffIsFeltByALightWithoutARange) {
    EXPECT_EQ(valuesOf(sensitiveTo({lightOf(LightKind::point, 3)}), "light-cutoff").size(), 1u);
    EXPECT_EQ(reasonOf(sensitiveTo({lightOf(LightKind::point, 3)}), "light-cutoff"),
              "every light has its own range");
    EXPECT_GT(valuesOf(sensitiveTo({lightOf(LightKind::point, 3), lightOf(LightKind::spot)}), "light-cutoff")
                  .size(),
              1u);
}

TEST(ExperimentSensitivity, AreaLightsAreVariedWhereThereIsOne) {
    EXPECT_EQ(valuesOf(sensitiveTo({lightOf(LightKind::point)}), "area-lights").size(), 1u);
    EXPECT_EQ(valuesOf(sensitiveTo({lightOf(LightKind::tube)}), "area-lights").size(), 2u);
}

// Point lights cast shadows if --shadow-lights selects them.
TEST(ExperimentSensitivity, ShadowsAreVariedWhereSomethingCasts) {
    const SweepRows none = sensitiveTo({lightOf(LightKind::rect)});
    EXPECT_EQ(valuesOf(none, "shadows").size(), 1u);
    EXPECT_EQ(valuesOf(none, "shadow-size").size(), 1u);
    EXPECT_EQ(valuesOf(none, "evsm-exponent").size(), 1u);
    EXPECT_EQ(reasonOf(none, "shadow-size"),
              "no light casts shadows: no sun, and no point or spot light selected by --shadow-lights");
    EXPECT_GT(valuesOf(sensitiveTo({lightOf(LightKind::point)}), "shadow-lights").size(), 1u);
}

// A primitive of one material.
Scene sceneOf(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.meshes.resize(1);
    scene.meshes[0].primitives.resize(1);
    scene.meshes[0].primitives[0].material = 0;
    return scene;
}
SweepRows sensitiveIn(const Scene& scene) {
    return sensitiveRows(makeSweepRows({}, defaultGrids({})), {}, &scene);
}

// Under an environment: black with a bright texel, or uniform.
SweepRows sensitiveUnder(const Material& material, bool even) {
    Scene scene = sceneOf(material);
    scene.environment = Environment{"sky", Image(16, 8, 3, even ? 1.0f : 0.0f)};
    if (!even) scene.environment->radiance.at(5, 2, 1) = 100;
    Settings requested;
    requested.env = "sky.exr";
    requested.multiscatter = Multiscatter::energy;
    return sensitiveRows(makeSweepRows(requested, defaultGrids(requested)), {}, &scene);
}

TEST(ExperimentSensitivity, AnEnvironmentIsVariedAsItsSurfacesFeelIt) {
    Material mixed, metal, matte;
    mixed.metallic = 0.5f;
    metal.metallic = 1;
    matte.metallic = matte.specular = 0;
    const SweepRows all = sensitiveUnder(mixed, false);
    EXPECT_EQ(valuesOf(all, "ibl-diffuse"), (std::set<std::string>{"sh", "sh-windowed", "map"}));
    EXPECT_EQ(valuesOf(all, "ibl-intensity"), (std::set<std::string>{"0", "1"})) << "without its light";
    for (const char* option : {"ibl", "specular-albedo", "multiscatter"})
        EXPECT_GT(valuesOf(all, option).size(), 1u) << option;
    for (const Ibl ibl : {Ibl::split, Ibl::sampled})
        for (const int samples : {32, 256, 1024})
            for (const float bias : {0.0f, 1.0f, 2.0f})
                EXPECT_TRUE(std::ranges::any_of(all.rows,
                                                [&](const Settings& row) {
                                                    return row.ibl == ibl && row.ibl_samples == samples &&
                                                           row.ibl_bias == bias;
                                                }) ||
                            (ibl == Ibl::sampled && bias != 0))
                    << nameOf(ibl) << " " << samples << " " << bias;
    EXPECT_EQ(reasonOf(all, "textures"), "no material reads a texture");
    EXPECT_EQ(reasonOf(sensitiveUnder(mixed, true), "ibl-diffuse"),
              "no spherical-harmonics irradiance is negative: sh-windowed equals sh");
    Material lacquered = matte;
    lacquered.clearcoat = 1;
    EXPECT_GT(valuesOf(sensitiveUnder(lacquered, false), "ibl").size(), 1u) << "the coat is specular";
    Material bubble = matte;
    bubble.iridescence = 1;
    EXPECT_GT(valuesOf(sensitiveUnder(bubble, false), "ibl").size(), 1u) << "the film is specular";
    const SweepRows of_matte = sensitiveUnder(matte, false);
    for (const char* option : {"ibl", "ibl-samples", "ibl-bias", "specular-albedo", "multiscatter"}) {
        EXPECT_EQ(valuesOf(of_matte, option).size(), 1u) << option;
        EXPECT_EQ(reasonOf(of_matte, option), "no surface is specular") << option;
    }
    EXPECT_EQ(valuesOf(of_matte, "ibl-diffuse").size(), 3u);
    // Except rows whose multiple scattering uses irradiance.
    const SweepRows of_metal = sensitiveUnder(metal, false);
    for (const Settings& row : of_metal.rows)
        EXPECT_TRUE(row.ibl_diffuse == IblDiffuse::sh || row.multiscatter == Multiscatter::fdez);
    metal.metallic_roughness_texture.texture = 0;
    EXPECT_EQ(valuesOf(sensitiveUnder(metal, false), "ibl-diffuse").size(), 3u) << "a texture darkens it";
    metal.metallic_roughness_texture = {};
    metal.sheen_color = {0, 1, 0};
    EXPECT_EQ(valuesOf(sensitiveUnder(metal, false), "ibl-diffuse").size(), 3u) << "a sheen reflects it";
}

TEST(ExperimentSensitivity, WhatPosesVerticesIsVariedWhereSomethingDeforms) {
    Scene scene = sceneOf({});
    Primitive& primitive = scene.meshes[0].primitives[0];
    const auto sensitive = [&] { return sensitiveIn(scene); };
    EXPECT_EQ(valuesOf(sensitive(), "skinning"), std::set<std::string>{"compute"});
    EXPECT_EQ(reasonOf(sensitive(), "skinning", "vertex"), "no vertex is skinned or morphed");
    primitive.targets.resize(1);
    EXPECT_EQ(valuesOf(sensitive(), "skinning"), (std::set<std::string>{"compute", "vertex"}));
    primitive.targets.clear();
    primitive.joint_sets.resize(1);
    EXPECT_EQ(valuesOf(sensitive(), "skinning").size(), 2u);
}

TEST(ExperimentSensitivity, TransparencyIsVariedWhereSomethingIsBlended) {
    Scene scene = sceneOf({});
    Material& material = scene.materials[0];
    const auto sensitive = [&] { return sensitiveIn(scene); };
    EXPECT_EQ(valuesOf(sensitive(), "transparency"), std::set<std::string>{"sorted"});
    EXPECT_EQ(valuesOf(sensitive(), "transparency-layers").size(), 1u);
    EXPECT_EQ(reasonOf(sensitive(), "transparency", "weighted"),
              "no material has alphaMode BLEND or transmits light");
    material.alpha_mode = AlphaMode::blend;
    material.unlit = true;
    EXPECT_GT(valuesOf(sensitive(), "transparency").size(), 3u);
    EXPECT_GT(valuesOf(sensitive(), "transparency-layers").size(), 1u);
}

// Glass alone has no order, but it can be left out. Its layers are in no G-buffer.
TEST(ExperimentSensitivity, GlassIsVariedByWhetherItIsDrawn) {
    Scene scene = sceneOf({});
    Material& material = scene.materials[0];
    material.transmission = material.clearcoat = 1;
    Settings off;
    off.transparency = Transparency::off;
    SweepRows sweep = makeSweepRows({}, defaultGrids({}));
    sweep.rows.push_back(off);
    const auto sensitive = [&] { return sensitiveRows(sweep, {}, &scene); };
    EXPECT_EQ(valuesOf(sensitive(), "transparency"), (std::set<std::string>{"off", "sorted"}));
    EXPECT_EQ(valuesOf(sensitive(), "transparency-layers").size(), 1u);
    EXPECT_EQ(reasonOf(sensitive(), "transparency", "weighted"),
              "no material has alphaMode BLEND: glass has one order");
    EXPECT_EQ(valuesOf(sensitive(), "layers").size(), 1u);
    EXPECT_TRUE(std::ranges::any_of(sensitive().skips, [](const SweepSkip& skip) {
        return skip.tried.size() == 2 && skip.tried[1].option == "layers" &&
               skip.reason == "no opaque material has a layer";
    }));
    material.transmission = 0;
    EXPECT_EQ(valuesOf(sensitive(), "layers").size(), 2u);
}

TEST(ExperimentSensitivity, HazeIsMarchedThroughWhereThereIsSome) {
    Settings requested;
    requested.haze = true;
    const auto sensitive = [&] {
        return sensitiveRows(makeSweepRows(requested, defaultGrids(requested)), {});
    };
    EXPECT_EQ(valuesOf(sensitive(), "haze-march-steps"), (std::set<std::string>{"0", "8", "32"}));
    requested.haze_density = 0;
    EXPECT_EQ(valuesOf(sensitive(), "haze-march-steps"), std::set<std::string>{"0"});
    EXPECT_EQ(reasonOf(sensitive(), "haze-march-steps"), "there is no haze");
    requested.haze_density = 1;
    requested.haze_rayleigh = {};
    EXPECT_EQ(valuesOf(sensitive(), "haze-march-steps").size(), 3u) << "aerosols alone";
    requested.haze_mie = {};
    EXPECT_EQ(valuesOf(sensitive(), "haze-march-steps").size(), 1u);
}

// Every skip names its path, and no two rows have the same image.
TEST(ExperimentSensitivity, NothingIsDrawnTwiceNorLostInSilence) {
    const SweepRows all = makeSweepRows({}, defaultGrids({}));
    const SweepRows sweep = sensitiveTo({lightOf(LightKind::directional)});
    EXPECT_LT(sweep.rows.size(), all.rows.size());
    EXPECT_EQ(sweep.rows.front(), Settings()) << "the given Settings stay first";
    for (const Settings& row : all.rows) {
        if (std::ranges::count(sweep.rows, row) > 0) continue;
        const bool said = std::ranges::any_of(sweep.skips, [&](const SweepSkip& skip) {
            return skip.tried.size() == 2 && skip.tried[0].value == nameOf(row.path) &&
                   row.valueOf(skip.tried[1].option) == skip.tried[1].value;
        });
        EXPECT_TRUE(said) << describe(changesOf(row, Settings()));
    }
}

}  // namespace
}  // namespace diptych::experiment
