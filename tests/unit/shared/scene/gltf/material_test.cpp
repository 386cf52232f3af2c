// SPDX-License-Identifier: MIT
#include "shared/scene/model/material_slots.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_material_builder.h"

#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

using namespace diptych;
using Json = nlohmann::json;

TEST(GltfMaterial, MaterialsTexturesSamplersAndTransforms) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.json["images"] = {{{"uri", "missing.png"}},
                        {{"uri", twoPixels}, {"name", "two"}}};  // nothing reads the first image
    f.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9985}}};
    f.json["textures"] = {{{"source", 0}}, {{"source", 1}, {"sampler", 0}}, {{"source", 1}}};
    const double quarter = std::acos(0.0);
    f.json["materials"] = {
        {{"name", "m"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
           {"metallicFactor", 0.5},
           {"baseColorTexture", {{"index", 1}, {"texCoord", 1}}}}},
         {"normalTexture",
          {{"index", 2},
           {"scale", 0.5},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {5, 6}}, {"rotation", quarter}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}},
         {"occlusionTexture", {{"index", 2}, {"strength", 0.25}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.75},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_ior", {{"ior", 1.3}}},
           {"KHR_materials_specular",
            {{"specularFactor", 0.5},
             {"specularColorFactor", {1, 2, 3}},
             {"specularTexture",
              {{"index", 2},
               {"texCoord", 1},
               {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}}}}}}}}};
    const Scene scene = f.load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(scene.materials.size(), 1u) << "no default where none is needed";
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.base_color_texture.texcoord, 1);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(m.occlusion_strength, 0.25f);
    EXPECT_EQ(m.emissive, glm::vec3(8, 4, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.75f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.ior, 1.3f);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, glm::vec3(1, 2, 3));
    EXPECT_EQ(m.specular_texture.u.z, 0.5);
    EXPECT_EQ(m.specular_texture.texcoord, 1);
    // Scale, then 90 degrees counter-clockwise with v downwards, (u, v) -> (v, -u), then the offset.
    const glm::dvec3 u(0, 3, 5), v(-2, 0, 6);
    EXPECT_EQ(m.normal_texture.texcoord, 1);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(m.normal_texture.u[c], u[c], 1e-12);
        EXPECT_NEAR(m.normal_texture.v[c], v[c], 1e-12);
    }
    ASSERT_EQ(scene.images.size(), 1u) << "only what a material reads";
    EXPECT_EQ(scene.images[0].width, 2);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    const Texture& texture = scene.textures.at(static_cast<std::size_t>(m.base_color_texture.texture));
    EXPECT_EQ(texture.image, 0);
    EXPECT_EQ(texture.sampler,
              (Sampler{Wrap::clamp_to_edge, Wrap::mirrored_repeat, false, true, true, false}));
    EXPECT_EQ(scene.textures.at(2).sampler, Sampler{});
}

TEST(GltfMaterial, WhatIsDrawnOtherwiseIsNoted) {
    GltfFile f = GltfFile::triangle();
    f.json["extensionsUsed"] = {"KHR_materials_subsurface"};
    f.json["materials"] = {{{"name", "glass"}, {"alphaMode", "BLEND"}}, {{"name", "plain"}}};
    const Scene scene = f.load();
    EXPECT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(f.only(scene).material, 2) << "the default material comes last";
    EXPECT_TRUE(mentions(scene.notes, "KHR_materials_subsurface"));
}

// Base colour, alpha and sidedness are kept; the rest is ignored, and its images are not even opened.
TEST(GltfMaterial, UnlitKeepsBaseColourAlphaAndSidesAlone) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.json["extensionsUsed"] = f.json["extensionsRequired"] = {"KHR_materials_unlit"};
    f.json["images"] = {{{"uri", twoPixels}}, {{"uri", "missing.png"}}};
    f.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    f.json["materials"] = {{{"name", "sign"},
                            {"pbrMetallicRoughness",
                             {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                              {"baseColorTexture", {{"index", 0}}},
                              {"metallicFactor", 0.25},
                              {"metallicRoughnessTexture", {{"index", 1}}}}},
                            {"normalTexture", {{"index", 1}}},
                            {"occlusionTexture", {{"index", 1}}},
                            {"emissiveFactor", {1, 1, 1}},
                            {"emissiveTexture", {{"index", 1}}},
                            {"alphaMode", "MASK"},
                            {"alphaCutoff", 0.25},
                            {"doubleSided", true},
                            {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    const Scene scene = f.load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.base_color_texture.texture, 0);
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.emissive, glm::vec3(0));
    for (const TextureSlot* slot : {&m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
                                    &m.emissive_texture, &m.specular_texture, &m.specular_color_texture})
        EXPECT_EQ(slot->texture, -1);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_FALSE(mentions(scene.notes, "unlit"));
    const Requirements r = requirements(scene, poseAt(scene, 0));
    EXPECT_TRUE(r.unlit && r.emission && r.dielectric_specular);
    EXPECT_EQ(r.max_emission, 0.3f) << "the base colour is what it emits";
}

// glTF 2.0, 5.19: the defaults.
TEST(GltfMaterial, AnEmptyMaterialIsTheDefault) {
    const Material m = materialOf(Json::object());
    EXPECT_EQ(m.base_color, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.emissive, glm::vec3(0));
    EXPECT_EQ(m.normal_scale, 1);
    EXPECT_EQ(m.occlusion_strength, 1);
    EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(m.alpha_cutoff, 0.5f);
    EXPECT_FALSE(m.double_sided || m.unlit);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.specular, 1);
    EXPECT_EQ(m.specular_color, glm::vec3(1));
    for (const MaterialSlot& slot : materialSlots) EXPECT_EQ((m.*slot.texture).texture, -1);
    for (const char* extension :
         {"KHR_materials_ior", "KHR_materials_specular", "KHR_materials_emissive_strength"}) {
        const Material same = materialOf({{"extensions", {{extension, Json::object()}}}});
        EXPECT_EQ(same.ior, 1.5f);
        EXPECT_EQ(same.specular, 1);
        EXPECT_EQ(same.specular_color, glm::vec3(1));
    }
}

// Numbers outside glTF's range are clamped, with a note.
TEST(GltfMaterial, FactorsOutsideTheirRangeAreNoted) {
    const std::string metal = "/pbrMetallicRoughness/", extension = "/extensions/KHR_materials_";
    const Json texture = {{"index", 0}};
    using Value = std::function<float(const Material&)>;
    const std::tuple<std::string, Json, Value, float, std::string> cases[] = {
        {metal + "baseColorFactor",
         {-1, 0, 0, 1},
         [](const Material& m) { return m.base_color.r; },
         0,
         "material 0: baseColorFactor -1 is outside 0 to 1: 0 is used"},
        {metal + "baseColorFactor",
         {0, 0, 1e30, 1},
         [](const Material& m) { return m.base_color.b; },
         1,
         "material 0: baseColorFactor 1e+30 is outside 0 to 1: 1 is used"},
        {metal + "metallicFactor", 2, &Material::metallic, 1, "metallicFactor 2 "},
        {metal + "roughnessFactor", -0.5, &Material::roughness, 0, "roughnessFactor -0.5 "},
        {"/occlusionTexture/strength", 3, &Material::occlusion_strength, 1, "occlusionTexture.strength 3 "},
        {"/normalTexture/scale", -1e38, &Material::normal_scale, -1e12f,
         "normalTexture.scale -1e+38 is outside -1e+12 to 1e+12"},
        {"/emissiveFactor",
         {0, -2, 0},
         [](const Material& m) { return m.emissive.g; },
         0,
         "emissiveFactor -2 "},
        {"/alphaCutoff", -1, &Material::alpha_cutoff, 0, "alphaCutoff -1 "},
        {extension + "ior/ior", 0.5, &Material::ior, 1,
         "material 0: ior 0.5 is not 0 or at least 1: 1 is used"},
        {extension + "ior/ior", 1e30, &Material::ior, 1e12f,  // as a mirror already
         "material 0: ior 1e+30 is outside 1 to 1e+12: 1e+12 is used"},
        {extension + "emissive_strength/emissiveStrength", -1, [](const Material& m) { return m.emissive.g; },
         0, "material 0: emissiveStrength -1 is outside 0 to "},
        // with few digits it would be printed as 1
        {metal + "metallicFactor", 1.00000001, &Material::metallic, 1,
         "metallicFactor 1.00000001 is outside 0 to 1: 1 is used"},
        {extension + "specular/specularFactor", 1.5, &Material::specular, 1, "specularFactor 1.5 "},
        {extension + "specular/specularColorFactor",
         {-1, 1, 1},
         [](const Material& m) { return m.specular_color.r; },
         0,
         "specularColorFactor -1 "}};
    for (const auto& [pointer, value, read, expected, note] : cases) {
        Json material = {{"normalTexture", texture},
                         {"occlusionTexture", texture},
                         {"alphaMode", "MASK"},
                         {"emissiveFactor", {1, 1, 1}}};
        material[Json::json_pointer(pointer)] = value;
        const Scene scene = withMaterial(material).load();
        EXPECT_EQ(read(scene.materials[0]), expected) << note;
        EXPECT_TRUE(mentions(scene.notes, note)) << note;
    }
}

// Numbers that glTF does not bound are kept, without a note.
TEST(GltfMaterial, FactorsWithoutBoundStay) {
    const Scene scene = withMaterial({{"normalTexture", {{"index", 0}, {"scale", -3}}},
                                      {"alphaMode", "MASK"},
                                      {"alphaCutoff", 1.5},
                                      {"emissiveFactor", {1, 0.5, 2}},
                                      {"extensions",
                                       {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1000}}},
                                        {"KHR_materials_ior", {{"ior", 0}}},
                                        {"KHR_materials_specular", {{"specularColorFactor", {4, 0, 1}}}}}}})
                            .load();
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.normal_scale, -3);
    EXPECT_EQ(m.alpha_cutoff, 1.5f) << "above 1 everything is cut out";
    EXPECT_EQ(m.emissive, glm::vec3(1000, 500, 2000));
    EXPECT_EQ(m.ior, 0) << "reflects everything";
    EXPECT_EQ(m.specular_color, glm::vec3(4, 0, 1));
    EXPECT_FALSE(mentions(scene.notes, "material 0: "));
}

TEST(GltfMaterial, EmissionBeyondAnyFloatIsRefused) {
    GltfFile f =
        withMaterial({{"emissiveFactor", {1e38, 0, 0}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}});
    EXPECT_TRUE(f.error().ends_with(": material 0: emits 1e+39, more than a float can store")) << f.error();
}
