// SPDX-License-Identifier: MIT
// KHR_materials_pbrSpecularGlossiness as a material, by its text: diffuse, F0 and glossiness replace
// pbrMetallicRoughness; an infinite index of refraction makes the specular colour F0.
#include "shared/scene/model/animated.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_material_builder.h"

#include <numbers>

using namespace diptych;
using Json = nlohmann::json;

namespace {

Json glossy(Json properties) {
    return {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", std::move(properties)}}}};
}

const std::string glossyPart = "extensions/KHR_materials_pbrSpecularGlossiness/",
                  turnedTexture = "Texture/extensions/KHR_texture_transform/rotation";

}  // namespace

TEST(GltfSpecularGlossiness, FactorsAndTexturesAreRead) {
    GltfFile f = withMaterial(glossy({{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                                      {"specularFactor", {0.5, 0.25, 0.125}},
                                      {"glossinessFactor", 0.75},
                                      {"diffuseTexture", {{"index", 0}}},
                                      {"specularGlossinessTexture", {{"index", 1}, {"texCoord", 1}}}}),
                              2);
    f.json["extensionsRequired"] = Json::array({"KHR_materials_pbrSpecularGlossiness"});
    const Scene scene = f.load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(m.specular_glossiness);
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.specular_color, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.ior, 0) << "the specular colour is F0";
    EXPECT_EQ(m.specular, 1) << "F90";
    EXPECT_EQ(m.base_color_texture.texture, 0);
    EXPECT_EQ(m.specular_color_texture.texture, 1);
    EXPECT_EQ(m.specular_color_texture.texcoord, 1);
    EXPECT_EQ(m.metallic_roughness_texture.texture, -1);
    EXPECT_FALSE(mentions(scene.notes, "material 0"));
    const Requirements r = requirements(scene, poseAt(scene, 0));
    EXPECT_TRUE(r.specular_glossiness && r.dielectric_specular && r.second_texcoord);
    EXPECT_EQ(r.textures, 2u);
}

TEST(GltfSpecularGlossiness, DefaultsAreAWhiteMirror) {
    const Material m = materialOf(glossy(Json::object()));
    EXPECT_TRUE(m.specular_glossiness);
    EXPECT_EQ(m.base_color, glm::vec4(1));
    EXPECT_EQ(m.specular_color, glm::vec3(1));
    EXPECT_EQ(m.roughness, 0);
    EXPECT_FALSE(materialOf(Json::object()).specular_glossiness);
}

// The fallback for other readers is not read; normal, occlusion and emission are common to both models.
TEST(GltfSpecularGlossiness, ReplacesTheFallback) {
    Json material = glossy({{"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"glossinessFactor", 0.5}});
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0, 0, 1}},
                                        {"metallicFactor", 0.25},
                                        {"roughnessFactor", 0.125},
                                        {"baseColorTexture", {{"index", 1}, {"texCoord", 2}}},
                                        {"metallicRoughnessTexture", {{"index", 1}}}};
    material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    material["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
    material["emissiveTexture"] = {{"index", 0}};
    material["emissiveFactor"] = {1, 0.5, 0};
    material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 4}};
    material["alphaMode"] = "BLEND";
    GltfFile f = withMaterial(material, 2);
    f.json["images"][1]["uri"] = "missing.png";  // never opened
    const Scene scene = f.load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.base_color, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.roughness, 0.5f);
    EXPECT_EQ(m.base_color_texture.texture, -1);
    EXPECT_EQ(m.metallic_roughness_texture.texture, -1);
    EXPECT_EQ(m.normal_texture.texture, 0);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(m.occlusion_strength, 0.25f);
    EXPECT_EQ(m.emissive_texture.texture, 0);
    EXPECT_EQ(m.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::blend);
    EXPECT_FALSE(mentions(scene.notes, "material 0"));
}

// These extensions exclude specular-glossiness in their own texts.
TEST(GltfSpecularGlossiness, ExtensionsOfTheOtherModelAreIgnoredWithANote) {
    Json material = glossy({{"specularFactor", {0.5, 0.5, 0.5}}});
    Json& more = material["extensions"];
    more["KHR_materials_ior"] = {{"ior", 2}};
    more["KHR_materials_specular"] = {
        {"specularFactor", 0.5}, {"specularColorFactor", {0, 0, 0}}, {"specularTexture", {{"index", 0}}}};
    more["KHR_materials_transmission"] = {{"transmissionFactor", 0.5}};
    more["KHR_materials_volume"] = {{"thicknessFactor", 1}};
    more["KHR_materials_dispersion"] = {{"dispersion", 1}};
    more["KHR_materials_diffuse_transmission"] = {{"diffuseTransmissionFactor", 1}};
    more["KHR_materials_clearcoat"] = {{"clearcoatFactor", 0.5}, {"clearcoatTexture", {{"index", 0}}}};
    more["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}, {"anisotropyTexture", {{"index", 0}}}};
    more["KHR_materials_sheen"] = {{"sheenColorFactor", {1, 1, 1}}, {"sheenColorTexture", {{"index", 0}}}};
    more["KHR_materials_iridescence"] = {{"iridescenceFactor", 1}, {"iridescenceTexture", {{"index", 0}}}};
    const Scene scene = withMaterial(material).load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.ior, 0);
    EXPECT_EQ(m.specular, 1);
    EXPECT_EQ(m.specular_color, glm::vec3(0.5f));
    EXPECT_EQ(m.specular_texture.texture, -1);
    EXPECT_EQ(m.transmission, 0);
    EXPECT_EQ(m.thickness, 0);
    EXPECT_EQ(m.dispersion, 0);
    EXPECT_EQ(layersOf(m), 0u);
    EXPECT_EQ(m.clearcoat_texture.texture, -1);
    EXPECT_EQ(m.anisotropy_texture.texture, -1);
    EXPECT_EQ(m.sheen_color_texture.texture, -1);
    EXPECT_EQ(m.iridescence_texture.texture, -1);
    for (const char* name : {"ior", "specular", "transmission", "volume", "dispersion",
                             "diffuse_transmission", "clearcoat", "anisotropy", "sheen", "iridescence"})
        EXPECT_TRUE(mentions(scene.notes, std::string("material 0: KHR_materials_") + name +
                                              " beside KHR_materials_pbrSpecularGlossiness: ignored"));
    EXPECT_EQ(scene.notes.size(), 10u);
}

// KHR_materials_unlit shows the base colour of pbrMetallicRoughness.
TEST(GltfSpecularGlossiness, UnlitReplacesIt) {
    Json material = glossy({{"diffuseFactor", {1, 1, 1, 1}}});
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 0.5, 0.75, 1};
    const Material m = materialOf(material);
    EXPECT_TRUE(m.unlit);
    EXPECT_FALSE(m.specular_glossiness);
    EXPECT_EQ(m.base_color, glm::vec4(0.25f, 0.5f, 0.75f, 1));
}

TEST(GltfSpecularGlossiness, FactorsOutsideTheirRangeAreNoted) {
    const Scene scene = withMaterial(glossy({{"diffuseFactor", {-1, 0, 0, 1}},
                                             {"specularFactor", {0, 2, 0}},
                                             {"glossinessFactor", 1.5}}))
                            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.base_color.r, 0);
    EXPECT_EQ(m.specular_color.g, 1);
    EXPECT_EQ(m.roughness, 0);
    for (const char* note : {"material 0: diffuseFactor -1 is outside 0 to 1: 0 is used",
                             "material 0: specularFactor 2 is outside 0 to 1: 1 is used",
                             "material 0: glossinessFactor 1.5 is outside 0 to 1: 1 is used"})
        EXPECT_TRUE(mentions(scene.notes, note)) << note;
    EXPECT_NE(withMaterial(glossy({{"glossinessFactor", "shiny"}})).error(), "");
    EXPECT_NE(withMaterial(glossy({{"specularFactor", {1, 1}}})).error(), "");
    EXPECT_NE(withMaterial(glossy({{"diffuseTexture", {{"index", 7}}}})).error(), "");
}

// ---- animation ---------------------------------------------------------------------------------------

TEST(GltfSpecularGlossiness, ItsFactorsAndTexturesMove) {
    GltfFile f = withMaterial(
        glossy({{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 0}}}}));
    animate(f, glossyPart + "diffuseFactor", {0, 0.5f, 0, 1, 1, 0.5f, 0.5f, 0});
    animate(f, glossyPart + "specularFactor", {0, 0.5f, 1, 1, 0.5f, 3});
    animate(f, glossyPart + "glossinessFactor", {0.25f, 0.75f});
    for (const char* texture : {"diffuse", "specularGlossiness"})
        animate(f, glossyPart + texture + turnedTexture, {0, std::numbers::pi_v<float>});
    const Scene scene = f.load();
    EXPECT_EQ(scene.animations.at(0).channels.size(), 5u);
    EXPECT_TRUE(mentions(scene.notes, "3 is outside 0 to 1: the nearest value is used"));
    const Material moved = poseAt(scene, 0.5).materials.at(0);
    EXPECT_EQ(moved.base_color, glm::vec4(0.5f, 0.5f, 0.25f, 0.5f));
    EXPECT_EQ(moved.specular_color, glm::vec3(0.5f, 0.5f, 1));
    EXPECT_EQ(moved.roughness, 0.5f);
    for (const TextureSlot* slot : {&moved.base_color_texture, &moved.specular_color_texture})
        EXPECT_NEAR(slot->u.y, 1, 1e-6) << "a quarter turn";
    EXPECT_EQ(poseAt(scene, 1).materials.at(0).specular_color.b, 1);
    EXPECT_EQ(poseAt(scene, 1).materials.at(0).roughness, 0.25f);
}

// Pointers to what this model or unlit replaces move nothing, beside its own.
TEST(GltfSpecularGlossiness, WhatIsReplacedDoesNotMove) {
    const Json texture = {{"index", 0}};
    Json material = glossy({{"diffuseFactor", {1, 1, 1, 1}}, {"diffuseTexture", texture}});
    material["pbrMetallicRoughness"]["baseColorTexture"] = texture;
    material["extensions"]["KHR_materials_specular"]["specularColorTexture"] = texture;
    GltfFile f = withMaterial(material);
    for (const auto& [property, width] : {std::pair{"pbrMetallicRoughness/baseColorFactor", 4u},
                                          {"pbrMetallicRoughness/metallicFactor", 1u},
                                          {"pbrMetallicRoughness/roughnessFactor", 1u},
                                          {"extensions/KHR_materials_ior/ior", 1u},
                                          {"extensions/KHR_materials_specular/specularFactor", 1u},
                                          {"extensions/KHR_materials_specular/specularColorFactor", 3u},
                                          {"extensions/KHR_materials_transmission/transmissionFactor", 1u},
                                          {"extensions/KHR_materials_clearcoat/clearcoatFactor", 1u},
                                          {"extensions/KHR_materials_anisotropy/anisotropyStrength", 1u},
                                          {"extensions/KHR_materials_sheen/sheenColorFactor", 3u},
                                          {"extensions/KHR_materials_iridescence/iridescenceFactor", 1u}})
        animate(f, property, std::vector<float>(2 * width, 0.125f));
    for (const char* of :
         {"pbrMetallicRoughness/baseColor", "extensions/KHR_materials_specular/specularColor"})
        animate(f, of + turnedTexture, {1, 2});
    EXPECT_TRUE(materialsThatMove(f.load()).empty());
    animate(f, glossyPart + "diffuseFactor", std::vector<float>(8, 0.25f));
    animate(f, "alphaCutoff", {0, 1});
    const Scene scene = f.load();
    EXPECT_EQ(scene.animations.at(0).channels.size(), 2u);
    EXPECT_FALSE(mentions(scene.notes, "channels left out"));
    const Material moved = poseAt(scene, 0.5).materials.at(0);
    EXPECT_EQ(moved.base_color, glm::vec4(0.25f));
    EXPECT_EQ(moved.alpha_cutoff, 0.5f);
    EXPECT_EQ(moved.transmission, 0);
    f.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    EXPECT_EQ(poseAt(f.load(), 0.5).materials.at(0).base_color, glm::vec4(0.125f))
        << "the base colour factor";

    GltfFile other = withMaterial(Json::object());
    animate(other, glossyPart + "glossinessFactor", {0, 1});
    EXPECT_TRUE(mentions(other.load().notes, "the material has no KHR_materials_pbrSpecularGlossiness"));
}
