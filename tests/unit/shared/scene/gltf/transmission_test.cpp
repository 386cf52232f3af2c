// SPDX-License-Identifier: MIT
// KHR_materials_transmission, _volume, _dispersion and _diffuse_transmission: factors, textures, notes.
#include "tests/support/gltf_material_builder.h"

#include <string>
#include <utility>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

namespace {

Json extended(std::vector<std::pair<const char*, Json>> extensions) {
    Json material{{"name", "pane"}};
    for (auto& [name, values] : extensions)
        material["extensions"][std::string("KHR_materials_") + name] = std::move(values);
    return material;
}

const Json half = {{"transmissionFactor", 0.5}}, thick = {{"thicknessFactor", 0.5}};

}  // namespace

// ---- reading -----------------------------------------------------------------------------------------

TEST(GltfTransmission, FactorsAndTexturesAreRead) {
    const Json second = {{"index", 3}, {"texCoord", 1}};
    const Scene scene =
        withMaterial(extended({{"transmission",
                                {{"transmissionFactor", 0.25}, {"transmissionTexture", {{"index", 0}}}}},
                               {"volume",
                                {{"thicknessFactor", 8},
                                 {"thicknessTexture", {{"index", 1}}},
                                 {"attenuationDistance", 0.125},
                                 {"attenuationColor", {1, 0.5, 0}}}},
                               {"dispersion", {{"dispersion", 5}}}}),
                     2)
            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.transmission, 0.25f);
    EXPECT_EQ(m.transmission_texture.texture, 0);
    EXPECT_EQ(m.thickness, 8);
    EXPECT_EQ(m.thickness_texture.texture, 1);
    EXPECT_EQ(m.attenuation_distance, 0.125f);
    EXPECT_EQ(m.attenuation_color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(m.dispersion, 5) << "may be above 1";
    EXPECT_EQ(layersOf(m), gpu::LAYER_TRANSMISSION);
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "nothing is left out";

    const Scene other = withMaterial(extended({{"diffuse_transmission",
                                                {{"diffuseTransmissionFactor", 0.75},
                                                 {"diffuseTransmissionTexture", second},
                                                 {"diffuseTransmissionColorFactor", {0, 0.5, 1}},
                                                 {"diffuseTransmissionColorTexture", {{"index", 2}}}}}}),
                                     4)
                            .load();
    const Material& leaf = other.materials.at(0);
    EXPECT_EQ(leaf.diffuse_transmission, 0.75f);
    EXPECT_EQ(leaf.diffuse_transmission_color, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(leaf.diffuse_transmission_texture.texture, 3);
    EXPECT_EQ(leaf.diffuse_transmission_texture.texcoord, 1);
    EXPECT_EQ(leaf.diffuse_transmission_color_texture.texture, 2);
    EXPECT_EQ(layersOf(leaf), gpu::LAYER_DIFFUSE_TRANSMISSION);
    EXPECT_FALSE(transmits(leaf) || blends(leaf)) << "it is opaque";
    EXPECT_FALSE(mentions(other.notes, "KHR_materials"));
}

// No thickness is a thin wall; no distance is infinite, which 0 stands for.
TEST(GltfTransmission, DefaultsTransmitNothing) {
    for (const Json& empty : {Json::object(), extended({{"transmission", Json::object()},
                                                        {"volume", Json::object()},
                                                        {"dispersion", Json::object()},
                                                        {"diffuse_transmission", Json::object()}})}) {
        const Material m = materialOf(empty);
        EXPECT_EQ(m.transmission, 0);
        EXPECT_EQ(m.thickness, 0);
        EXPECT_EQ(m.attenuation_distance, 0);
        EXPECT_EQ(m.attenuation_color, glm::vec3(1));
        EXPECT_EQ(m.dispersion, 0);
        EXPECT_EQ(m.diffuse_transmission, 0);
        EXPECT_EQ(m.diffuse_transmission_color, glm::vec3(1));
        EXPECT_EQ(layersOf(m), 0u);
    }
}

TEST(GltfTransmission, RequiredExtensionsAreSupported) {
    GltfFile f = withMaterial(extended({{"transmission", half}, {"volume", thick}}));
    f.json["extensionsUsed"] =
        f.json["extensionsRequired"] = {"KHR_materials_transmission", "KHR_materials_volume",
                                        "KHR_materials_dispersion", "KHR_materials_diffuse_transmission"};
    EXPECT_EQ(f.error(), "");
}

TEST(GltfTransmission, FactorsOutsideTheirRangeAreNoted) {
    struct Case {
        const char* extension;
        Json values;
        float Material::*member;
        float expected;
        const char* note;
    };
    const Case cases[] = {{"volume",
                           {{"thicknessFactor", -1}},
                           &Material::thickness,
                           0,
                           "material 0: thicknessFactor -1 is outside 0 to 1e+12: 0 is used"},
                          {"volume",
                           {{"attenuationDistance", 0}},
                           &Material::attenuation_distance,
                           1e-12f,
                           "material 0: attenuationDistance 0 is outside 1e-12 to 1e+12: 1e-12 is used"},
                          {"volume",
                           {{"attenuationDistance", -2}},
                           &Material::attenuation_distance,
                           1e-12f,
                           "material 0: attenuationDistance -2 is outside 1e-12 to 1e+12: 1e-12 is used"},
                          {"dispersion",
                           {{"dispersion", -0.5}},
                           &Material::dispersion,
                           0,
                           "material 0: dispersion -0.5 is outside 0 to 1e+12: 0 is used"},
                          {"diffuse_transmission",
                           {{"diffuseTransmissionFactor", 1.5}},
                           &Material::diffuse_transmission,
                           1,
                           "material 0: diffuseTransmissionFactor 1.5 is outside 0 to 1: 1 is used"}};
    for (const Case& c : cases) {
        const Scene scene = withMaterial(extended({{c.extension, c.values}})).load();
        EXPECT_EQ(scene.materials[0].*c.member, c.expected) << c.note;
        EXPECT_TRUE(mentions(scene.notes, c.note)) << c.note;
    }
    const Scene colors =
        withMaterial(extended({{"volume", {{"attenuationColor", {-1, 0.5, 2}}}},
                               {"diffuse_transmission", {{"diffuseTransmissionColorFactor", {2, 0.5, -1}}}}}))
            .load();
    EXPECT_EQ(colors.materials[0].attenuation_color, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(colors.materials[0].diffuse_transmission_color, glm::vec3(1, 0.5f, 0));
    EXPECT_TRUE(mentions(colors.notes, "material 0: attenuationColor 2 is outside 0 to 1: 1 is used"));
    EXPECT_TRUE(mentions(colors.notes, "diffuseTransmissionColorFactor -1 is outside 0 to 1: 0 is used"));
}

TEST(GltfTransmission, WrongTypesAreRefused) {
    const std::pair<const char*, Json> wrong[] = {
        {"transmission", {{"transmissionTexture", {{"index", 7}}}}},
        {"volume", {{"thicknessFactor", "thick"}}},
        {"volume", {{"attenuationColor", {1, 1}}}},
        {"volume", {{"thicknessTexture", Json::object()}}},
        {"dispersion", {{"dispersion", Json::array({1})}}},
        {"diffuse_transmission", {{"diffuseTransmissionColorFactor", {1, 1, 1, 1}}}},
        {"diffuse_transmission", {{"diffuseTransmissionTexture", {{"index", 7}}}}}};
    for (const auto& [name, values] : wrong)
        EXPECT_NE(withMaterial(extended({{name, values}})).error(), "") << name << " " << values;
}

// ---- notes -------------------------------------------------------------------------------------------

TEST(GltfTransmission, ExtensionsWithoutEffectAreNoted) {
    const Json color = {{"diffuseTransmissionFactor", 1}}, disperse = {{"dispersion", 1}};
    const std::string volume = "1 material (pane) with KHR_materials_volume, but without transmission",
                      dispersion = "1 material (pane) with KHR_materials_dispersion, but without",
                      scattering = "1 material (pane) with KHR_materials_diffuse_transmission and a volume";
    struct Case {
        std::vector<std::pair<const char*, Json>> extensions;
        std::vector<std::string> notes;
    };
    const Case cases[] = {{{{"volume", thick}}, {volume}},
                          {{{"volume", thick}, {"transmission", half}}, {}},
                          {{{"volume", Json::object()}, {"diffuse_transmission", color}}, {}},
                          {{{"volume", thick}, {"diffuse_transmission", color}}, {scattering}},
                          {{{"dispersion", disperse}, {"transmission", half}}, {dispersion}},
                          {{{"dispersion", disperse}, {"volume", thick}}, {volume, dispersion}},
                          {{{"dispersion", disperse}, {"volume", thick}, {"transmission", half}}, {}}};
    for (const auto& [extensions, notes] : cases) {
        const Scene scene = withMaterial(extended(extensions)).load();
        EXPECT_EQ(scene.notes.size(), notes.size()) << extended(extensions);
        for (const std::string& note : notes) EXPECT_TRUE(mentions(scene.notes, note)) << note;
    }
}

// A factor of 0 that an animation raises has an effect.
TEST(GltfTransmission, AnimatedFactorsHaveAnEffect) {
    GltfFile f = withMaterial(extended({{"transmission", {{"transmissionFactor", 0}}},
                                        {"volume", {{"thicknessFactor", 0.5}}},
                                        {"dispersion", {{"dispersion", 1}}}}));
    EXPECT_EQ(f.load().notes.size(), 2u);
    const Json pointer = {
        {"pointer", "/materials/0/extensions/KHR_materials_transmission/transmissionFactor"}};
    f.json["animations"] = Json::array(
        {{{"samplers", Json::array({{{"input", f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1)},
                                     {"output", f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1)}}})},
          {"channels",
           Json::array({{{"sampler", 0},
                         {"target",
                          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}}})}}});
    const Scene scene = f.load();
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials"));
}

TEST(GltfTransmission, UnlitMaterialsHaveNone) {
    const Json texture = {{"index", 0}};
    const Scene scene =
        withMaterial(
            extended({{"transmission", {{"transmissionFactor", 1}, {"transmissionTexture", texture}}},
                      {"volume", {{"thicknessFactor", 1}, {"thicknessTexture", texture}}},
                      {"dispersion", {{"dispersion", 1}}},
                      {"diffuse_transmission", {{"diffuseTransmissionFactor", 1}}},
                      {"unlit", Json::object()}}))
            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.transmission, 0);
    EXPECT_EQ(m.thickness, 0);
    EXPECT_EQ(m.dispersion, 0);
    EXPECT_EQ(m.diffuse_transmission, 0);
    EXPECT_EQ(m.transmission_texture.texture, -1);
    EXPECT_EQ(layersOf(m), 0u);
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(scene.notes.size(), 1u);
    EXPECT_TRUE(mentions(scene.notes,
                         "1 material (pane) with KHR_materials_unlit: light that they transmit is left out"));
}
