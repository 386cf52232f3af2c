// SPDX-License-Identifier: MIT
// KHR_materials_clearcoat and KHR_materials_anisotropy: factors, textures, tangents, animation.
#include "shared/scene/model/material_slots.h"
#include "shared/scene/motion/posed.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_material_builder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

namespace {

Json coated(Json coat) {
    return Json{{"extensions", {{"KHR_materials_clearcoat", std::move(coat)}}}};
}
Json brushed(Json anisotropy) {
    return Json{{"extensions", {{"KHR_materials_anisotropy", std::move(anisotropy)}}}};
}
Json merged(Json a, const Json& b) {
    a.merge_patch(b);
    return a;
}

// One triangle in z = 0. By TEXCOORD_0, u grows along +Y; by TEXCOORD_1, along -X.
GltfFile mapped(Json material) {
    GltfFile f = withMaterial(std::move(material));
    f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor<float>({0, 0, 0, 1, 1, 0}, FLOAT, "VEC2", 2);
    f.primitive()["attributes"]["TEXCOORD_1"] = f.accessor<float>({1, 0, 0, 0, 1, 1}, FLOAT, "VEC2", 2);
    return f;
}

// Keys of one number at 0 s and 1 s; `property`: from the material on.
void animate(GltfFile& f, const std::string& property, float from, float to) {
    const Json pointer = {{"pointer", "/materials/0/extensions/" + property}};
    f.json["animations"] = Json::array(
        {{{"samplers", Json::array({{{"input", f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1)},
                                     {"output", f.accessor<float>({from, to}, FLOAT, "SCALAR", 1)}}})},
          {"channels",
           Json::array({{{"sampler", 0},
                         {"target",
                          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}}})}}});
}

void expectTangents(const std::vector<glm::vec4>& tangents, const glm::vec3& expected, const char* what) {
    ASSERT_FALSE(tangents.empty()) << what;
    for (const glm::vec4& t : tangents) EXPECT_LT(glm::distance(glm::vec3(t), expected), 1e-6f) << what;
}

constexpr const char* arbitrary = "direction of anisotropy is arbitrary: no tangents, no texture coordinates";

}  // namespace

// ---- reading -----------------------------------------------------------------------------------------

TEST(GltfLayers, FactorsAndTexturesAreRead) {
    const Json texture = {{"index", 0}, {"texCoord", 1}};
    const Scene scene =
        withMaterial(merged(coated({{"clearcoatFactor", 0.25},
                                    {"clearcoatTexture", texture},
                                    {"clearcoatRoughnessFactor", 0.5},
                                    {"clearcoatRoughnessTexture", {{"index", 1}}},
                                    {"clearcoatNormalTexture", {{"index", 2}, {"scale", -2}}}}),
                            brushed({{"anisotropyStrength", 0.75},
                                     {"anisotropyRotation", -100},
                                     {"anisotropyTexture", {{"index", 3}}}})),
                     4)
            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.clearcoat, 0.25f);
    EXPECT_EQ(m.clearcoat_roughness, 0.5f);
    EXPECT_EQ(m.clearcoat_normal_scale, -2);
    EXPECT_EQ(m.anisotropy, 0.75f);
    EXPECT_EQ(m.anisotropy_rotation, -100) << "any finite angle";
    EXPECT_EQ(m.clearcoat_texture.texture, 0);
    EXPECT_EQ(m.clearcoat_texture.texcoord, 1);
    EXPECT_EQ(m.clearcoat_roughness_texture.texture, 1);
    EXPECT_EQ(m.clearcoat_normal_texture.texture, 2);
    EXPECT_EQ(m.anisotropy_texture.texture, 3);
    EXPECT_EQ(scene.images.size(), 4u);
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "nothing is left out";
}

TEST(GltfLayers, DefaultsAreNoCoatAndNoAnisotropy) {
    for (const Json& empty : {Json::object(), coated(Json::object()), brushed(Json::object()),
                              coated({{"clearcoatNormalTexture", {{"index", 0}}}})}) {
        const Material m = materialOf(empty);
        EXPECT_EQ(m.clearcoat, 0);
        EXPECT_EQ(m.clearcoat_roughness, 0);
        EXPECT_EQ(m.clearcoat_normal_scale, 1);
        EXPECT_EQ(m.anisotropy, 0);
        EXPECT_EQ(m.anisotropy_rotation, 0);
    }
}

TEST(GltfLayers, RequiredExtensionsAreSupported) {
    GltfFile f = withMaterial(merged(coated({{"clearcoatFactor", 1}}), brushed(Json::object())));
    f.json["extensionsUsed"] =
        f.json["extensionsRequired"] = {"KHR_materials_clearcoat", "KHR_materials_anisotropy"};
    EXPECT_EQ(f.error(), "");
}

TEST(GltfLayers, FactorsOutsideTheirRangeAreNoted) {
    struct Case {
        Json material;
        float Material::*member;
        float expected;
        const char* note;
    };
    const Case cases[] = {
        {coated({{"clearcoatFactor", 1.5}}), &Material::clearcoat, 1,
         "material 0: clearcoatFactor 1.5 is outside 0 to 1: 1 is used"},
        {coated({{"clearcoatRoughnessFactor", -1}}), &Material::clearcoat_roughness, 0,
         "material 0: clearcoatRoughnessFactor -1 is outside 0 to 1: 0 is used"},
        {coated({{"clearcoatNormalTexture", {{"index", 0}, {"scale", 1e30}}}}),
         &Material::clearcoat_normal_scale, 1e12f, "material 0: clearcoatNormalTexture.scale 1e+30 "},
        {brushed({{"anisotropyStrength", 2}}), &Material::anisotropy, 1,
         "material 0: anisotropyStrength 2 is outside 0 to 1: 1 is used"}};
    for (const Case& c : cases) {
        const Scene scene = withMaterial(c.material).load();
        EXPECT_EQ(scene.materials[0].*c.member, c.expected) << c.note;
        EXPECT_TRUE(mentions(scene.notes, c.note)) << c.note;
    }
    for (const Json& wrong :
         {coated({{"clearcoatFactor", "all"}}), brushed({{"anisotropyStrength", Json::array({1})}}),
          coated({{"clearcoatTexture", {{"index", 7}}}})})
        EXPECT_NE(withMaterial(wrong).error(), "") << wrong;
}

TEST(GltfLayers, UnlitMaterialsHaveNone) {
    Json material = merged(coated({{"clearcoatFactor", 1}, {"clearcoatTexture", {{"index", 0}}}}),
                           brushed({{"anisotropyStrength", 1}, {"anisotropyTexture", {{"index", 0}}}}));
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const Scene scene = withMaterial(material).load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.clearcoat, 0);
    EXPECT_EQ(m.anisotropy, 0);
    EXPECT_EQ(m.clearcoat_texture.texture, -1);
    EXPECT_EQ(m.anisotropy_texture.texture, -1);
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
}

// ---- tangents ----------------------------------------------------------------------------------------

// The normal texture decides, then the clear coat normal's, then the anisotropy texture's, then TEXCOORD_0.
TEST(GltfLayers, TangentsFollowTheMapThatDefinesThem) {
    const Json first = {{"index", 0}}, second = {{"index", 0}, {"texCoord", 1}};
    const Json turned = {
        {"index", 0},
        {"extensions", {{"KHR_texture_transform", {{"rotation", std::numbers::pi}, {"scale", {2, 2}}}}}}};
    const auto texture = [](const Json& info) {
        return brushed({{"anisotropyStrength", 0.5}, {"anisotropyTexture", info}});
    };
    const auto coat = [](const Json& info) {
        return coated({{"clearcoatFactor", 1}, {"clearcoatNormalTexture", info}});
    };
    const glm::vec3 by_first(0, 1, 0), by_second(-1, 0, 0);
    const std::tuple<const char*, Json, glm::vec3> cases[] = {
        {"strength alone", brushed({{"anisotropyStrength", 0.5}}), by_first},
        {"anisotropy texture", texture(second), by_second},
        {"turned anisotropy texture", texture(turned), -by_first},
        {"clear coat normal", coat(second), by_second},
        {"clear coat normal before anisotropy", merged(coat(second), texture(first)), by_second},
        {"normal before clear coat normal", merged(coat(second), Json{{"normalTexture", first}}), by_first},
        {"normal before anisotropy", merged(texture(turned), Json{{"normalTexture", second}}), by_second}};
    for (const auto& [what, material, expected] : cases) {
        GltfFile f = mapped(material);
        const Scene scene = f.load();
        EXPECT_TRUE(f.only(scene).tangents_made) << what;
        expectTangents(f.only(scene).tangents, expected, what);
        EXPECT_FALSE(mentions(scene.notes, arbitrary)) << what;
    }
}

TEST(GltfLayers, TheFilesOwnTangentsStay) {
    GltfFile f = mapped(brushed({{"anisotropyStrength", 0.5}}));
    f.primitive()["attributes"]["NORMAL"] = f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    f.primitive()["attributes"]["TANGENT"] =
        f.accessor<float>({0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1}, FLOAT, "VEC4", 4);
    const Scene scene = f.load();
    EXPECT_FALSE(f.only(scene).tangents_made);
    expectTangents(f.only(scene).tangents, {0, -1, 0}, "TANGENT");
    EXPECT_EQ(f.only(scene).tangents[0].w, -1);
}

TEST(GltfLayers, AnisotropyWithoutTangentsAndCoordinatesIsNoted) {
    const Scene scene = withMaterial(brushed({{"anisotropyStrength", 0.5}})).load();
    EXPECT_TRUE(mentions(scene.notes, arbitrary));
    for (const glm::vec4& t : scene.meshes.at(0).primitives.at(0).tangents)
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
    EXPECT_FALSE(mentions(withMaterial(coated({{"clearcoatFactor", 1}})).load().notes, arbitrary));
}

// ---- animation ---------------------------------------------------------------------------------------

// A material that is isotropic at rest has tangents for the time when it is not.
TEST(GltfLayers, AnimatedStrengthNeedsTangentsFromTheStart) {
    const char* const strength = "KHR_materials_anisotropy/anisotropyStrength";
    GltfFile f = mapped(brushed(Json::object()));
    animate(f, strength, 0, 1);
    const Scene scene = f.load();
    ASSERT_EQ(scene.animations.size(), 1u);
    expectTangents(f.only(scene).tangents, {0, 1, 0}, strength);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0.5)).layers, gpu::LAYER_ANISOTROPY);
    GltfFile bare = withMaterial(brushed(Json::object()));
    animate(bare, strength, 0, 1);
    EXPECT_TRUE(mentions(bare.load().notes, arbitrary));
}

// Turns the texture whose coordinates define tangents by half a turn; the other one leaves them.
TEST(GltfLayers, TangentsTurnWithTheMapThatDefinesThem) {
    const Json info = {{"index", 0}};
    const Json both = merged(coated({{"clearcoatFactor", 1}, {"clearcoatNormalTexture", info}}),
                             brushed({{"anisotropyStrength", 1}, {"anisotropyTexture", info}}));
    const std::tuple<Json, const char*, double> cases[] = {
        {both, "KHR_materials_clearcoat/clearcoatNormalTexture", -1},
        {both, "KHR_materials_anisotropy/anisotropyTexture", 1},
        {brushed({{"anisotropyStrength", 1}, {"anisotropyTexture", info}}),
         "KHR_materials_anisotropy/anisotropyTexture", -1}};
    for (const auto& [material, slot, sign] : cases) {
        GltfFile f = mapped(material);
        animate(f, fmt::format("{}/extensions/KHR_texture_transform/rotation", slot), 0,
                std::numbers::pi_v<float>);
        const Scene scene = f.load();
        const Pose pose = poseAt(scene, 1);
        ASSERT_EQ(pose.instances.size(), 1u);
        EXPECT_EQ(pose.instances[0].map_rotated, sign < 0) << slot;
        for (const glm::dvec3& t : posedVertices(scene, pose, pose.instances[0]).tangents)
            EXPECT_LT(glm::distance(t, glm::dvec3(0, sign, 0)), 1e-6) << slot;
    }
}

TEST(GltfLayers, TransformsOfMissingTexturesAreNotAnimated) {
    for (const char* slot :
         {"KHR_materials_clearcoat/clearcoatTexture", "KHR_materials_clearcoat/clearcoatRoughnessTexture",
          "KHR_materials_clearcoat/clearcoatNormalTexture", "KHR_materials_anisotropy/anisotropyTexture"}) {
        GltfFile f = mapped(merged(coated({{"clearcoatFactor", 1}}), brushed({{"anisotropyStrength", 1}})));
        animate(f, fmt::format("{}/extensions/KHR_texture_transform/rotation", slot), 0, 1);
        const Scene scene = f.load();
        EXPECT_TRUE(scene.animations.empty()) << slot;
        EXPECT_TRUE(mentions(scene.notes, "the material has no such texture")) << slot;
    }
}

// ---- files -------------------------------------------------------------------------------------------

TEST(GltfLayers, RealFilesHaveTheirLayers) {
    const std::filesystem::path assets = DIPTYCH_SOURCE_DIR "/../shared/assets/layered";
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": real files are not tried";
    struct Row {
        const char* file;
        std::size_t coats, anisotropic;
        gpu::uint layers;
    };
    for (const Row& row :
         {Row{"ClearCoatTest/ClearCoatTest.glb", 6, 0, gpu::LAYER_CLEARCOAT},
          Row{"AnisotropyRotationTest/AnisotropyRotationTest.glb", 0, 4, gpu::LAYER_ANISOTROPY},
          // 7 x 7 balls, strength 0 in the first column
          Row{"AnisotropyStrengthTest/AnisotropyStrengthTest.glb", 0, 42, gpu::LAYER_ANISOTROPY}}) {
        const Scene scene = loadScene((assets / row.file).string());
        std::size_t coats = 0, anisotropic = 0;
        for (const Material& m : scene.materials) {
            coats += m.clearcoat > 0;
            anisotropic += m.anisotropy > 0;
        }
        EXPECT_EQ(coats, row.coats) << row.file;
        EXPECT_EQ(anisotropic, row.anisotropic) << row.file;
        EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, row.layers) << row.file;
        EXPECT_FALSE(mentions(scene.notes, "arbitrary")) << row.file;
    }
}
