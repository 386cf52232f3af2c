// SPDX-License-Identifier: MIT
// KHR_materials_clearcoat, _anisotropy, _sheen and _iridescence: factors, textures, tangents, animation.
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"
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
Json sheened(Json sheen) {
    return Json{{"extensions", {{"KHR_materials_sheen", std::move(sheen)}}}};
}
Json filmed(Json film) {
    return Json{{"extensions", {{"KHR_materials_iridescence", std::move(film)}}}};
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

// Keys at 0 s and 1 s, each of one number or three; `property`: from the material on.
void animate(GltfFile& f, const std::string& property, const std::vector<float>& from,
             const std::vector<float>& to) {
    std::vector<float> keys = from;
    keys.insert(keys.end(), to.begin(), to.end());
    const int output = f.accessor<float>(keys, FLOAT, from.size() == 1 ? "SCALAR" : "VEC3", from.size());
    const Json pointer = {{"pointer", "/materials/0/extensions/" + property}};
    f.json["animations"] = Json::array(
        {{{"samplers",
           Json::array({{{"input", f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1)}, {"output", output}}})},
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

TEST(GltfLayers, SheensAndTheirTexturesAreRead) {
    const Json texture = {{"index", 0}, {"texCoord", 1}};
    const Scene scene = withMaterial(sheened({{"sheenColorFactor", {0.25, 0.5, 1}},
                                              {"sheenColorTexture", {{"index", 1}}},
                                              {"sheenRoughnessFactor", 0.75},
                                              {"sheenRoughnessTexture", texture}}),
                                     2)
                            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.sheen_color, glm::vec3(0.25f, 0.5f, 1));
    EXPECT_EQ(m.sheen_roughness, 0.75f);
    EXPECT_EQ(m.sheen_color_texture.texture, 1);
    EXPECT_EQ(m.sheen_color_texture.texcoord, 0);
    EXPECT_EQ(m.sheen_roughness_texture.texture, 0);
    EXPECT_EQ(m.sheen_roughness_texture.texcoord, 1);
    EXPECT_EQ(scene.images.size(), 2u);
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "nothing is left out";
}

TEST(GltfLayers, FilmsAndTheirTexturesAreRead) {
    const Json texture = {{"index", 0}, {"texCoord", 1}};
    const Scene scene = withMaterial(filmed({{"iridescenceFactor", 0.25},
                                             {"iridescenceTexture", {{"index", 1}}},
                                             {"iridescenceIor", 1.75},
                                             {"iridescenceThicknessMinimum", 600},
                                             {"iridescenceThicknessMaximum", 50},
                                             {"iridescenceThicknessTexture", texture}}),
                                     2)
                            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.iridescence, 0.25f);
    EXPECT_EQ(m.iridescence_ior, 1.75f);
    EXPECT_EQ(m.iridescence_thickness_least, 600) << "may be above the other";
    EXPECT_EQ(m.iridescence_thickness_most, 50);
    EXPECT_EQ(m.iridescence_texture.texture, 1);
    EXPECT_EQ(m.iridescence_texture.texcoord, 0);
    EXPECT_EQ(m.iridescence_thickness_texture.texture, 0);
    EXPECT_EQ(m.iridescence_thickness_texture.texcoord, 1);
    EXPECT_EQ(scene.images.size(), 2u);
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "nothing is left out";
}

TEST(GltfLayers, DefaultsAreNoSheenAndNoFilm) {
    for (const Json& empty : {Json::object(), sheened(Json::object()), filmed(Json::object()),
                              sheened({{"sheenRoughnessFactor", 0.5}})}) {
        const Material m = materialOf(empty);
        EXPECT_EQ(m.sheen_color, glm::vec3(0));
        EXPECT_EQ(m.iridescence, 0);
        EXPECT_EQ(m.iridescence_ior, 1.3f);
        EXPECT_EQ(m.iridescence_thickness_least, 100);
        EXPECT_EQ(m.iridescence_thickness_most, 400);
        EXPECT_EQ(layersOf(m), 0u);
    }
    EXPECT_EQ(materialOf(sheened({{"sheenColorFactor", {0, 0, 1}}})).sheen_roughness, 0);
}

// One component of the colour is a sheen.
TEST(GltfLayers, ASheenOfOneComponentIsALayer) {
    for (int c = 0; c < 3; ++c) {
        std::vector<double> color(3, 0.0);
        color[static_cast<std::size_t>(c)] = 0.01;
        EXPECT_EQ(layersOf(materialOf(sheened({{"sheenColorFactor", color}}))), gpu::LAYER_SHEEN) << c;
    }
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
        f.json["extensionsRequired"] = {"KHR_materials_clearcoat", "KHR_materials_anisotropy",
                                        "KHR_materials_sheen", "KHR_materials_iridescence"};
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
         "material 0: anisotropyStrength 2 is outside 0 to 1: 1 is used"},
        {sheened({{"sheenRoughnessFactor", 1.5}}), &Material::sheen_roughness, 1,
         "material 0: sheenRoughnessFactor 1.5 is outside 0 to 1: 1 is used"},
        {filmed({{"iridescenceFactor", -0.5}}), &Material::iridescence, 0,
         "material 0: iridescenceFactor -0.5 is outside 0 to 1: 0 is used"},
        {filmed({{"iridescenceIor", 0.5}}), &Material::iridescence_ior, 1,
         "material 0: iridescenceIor 0.5 is outside 1 to 1e+12: 1 is used"},
        {filmed({{"iridescenceThicknessMinimum", -1}}), &Material::iridescence_thickness_least, 0,
         "material 0: iridescenceThicknessMinimum -1 is outside 0 to 65504: 0 is used"},
        {filmed({{"iridescenceThicknessMaximum", 65505}}), &Material::iridescence_thickness_most, 65504,
         "material 0: iridescenceThicknessMaximum 65505 is outside 0 to 65504: 65504 is used"}};
    for (const Case& c : cases) {
        const Scene scene = withMaterial(c.material).load();
        EXPECT_EQ(scene.materials[0].*c.member, c.expected) << c.note;
        EXPECT_TRUE(mentions(scene.notes, c.note)) << c.note;
    }
    for (const Json& wrong :
         {coated({{"clearcoatFactor", "all"}}), brushed({{"anisotropyStrength", Json::array({1})}}),
          coated({{"clearcoatTexture", {{"index", 7}}}}), sheened({{"sheenColorFactor", {1, 1}}}),
          sheened({{"sheenRoughnessTexture", {{"index", 7}}}}), filmed({{"iridescenceIor", "glass"}}),
          filmed({{"iridescenceThicknessTexture", Json::object()}})})
        EXPECT_NE(withMaterial(wrong).error(), "") << wrong;
}

TEST(GltfLayers, SheenColoursOutsideTheirRangeAreNoted) {
    const Scene scene = withMaterial(sheened({{"sheenColorFactor", {-1, 0.5, 2}}})).load();
    EXPECT_EQ(scene.materials.at(0).sheen_color, glm::vec3(0, 0.5f, 1));
    for (const char* note : {"material 0: sheenColorFactor -1 is outside 0 to 1: 0 is used",
                             "material 0: sheenColorFactor 2 is outside 0 to 1: 1 is used"})
        EXPECT_TRUE(mentions(scene.notes, note)) << note;
}

TEST(GltfLayers, UnlitMaterialsHaveNone) {
    Json material = merged(coated({{"clearcoatFactor", 1}, {"clearcoatTexture", {{"index", 0}}}}),
                           brushed({{"anisotropyStrength", 1}, {"anisotropyTexture", {{"index", 0}}}}));
    material =
        merged(material, sheened({{"sheenColorFactor", {1, 1, 1}}, {"sheenColorTexture", {{"index", 0}}}}));
    material = merged(material, filmed({{"iridescenceFactor", 1}, {"iridescenceTexture", {{"index", 0}}}}));
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const Scene scene = withMaterial(material).load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.clearcoat, 0);
    EXPECT_EQ(m.anisotropy, 0);
    EXPECT_EQ(m.clearcoat_texture.texture, -1);
    EXPECT_EQ(m.anisotropy_texture.texture, -1);
    EXPECT_EQ(m.sheen_color, glm::vec3(0));
    EXPECT_EQ(m.iridescence, 0);
    EXPECT_EQ(m.sheen_color_texture.texture, -1);
    EXPECT_EQ(m.iridescence_texture.texture, -1);
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

// Each normal texture has the tangents of its own coordinates, and so has anisotropy.
TEST(GltfLayers, EachMapHasTheTangentsOfItsCoordinates) {
    const auto info = [](int set, double degrees = 0, double scale = 1) {
        return Json{{"index", 0},
                    {"texCoord", set},
                    {"extensions",
                     {{"KHR_texture_transform",
                       {{"rotation", degrees * std::numbers::pi / 180}, {"scale", {scale, 2}}}}}}};
    };
    const Json base = {{"normalTexture", info(0, 90)}};
    const auto coat = [&](const Json& map) {
        return merged(coated({{"clearcoatFactor", 1}, {"clearcoatNormalTexture", map}}), base);
    };
    const auto texture = [&](const Json& map) {
        return merged(brushed({{"anisotropyStrength", 0.5}, {"anisotropyTexture", map}}), base);
    };
    const Json strength = brushed({{"anisotropyStrength", 0.5}});
    const glm::vec3 by_first(0, 1, 0), by_second(-1, 0, 0), none(0);
    const std::tuple<const char*, Json, glm::vec3, float> cases[] = {
        {"coat", coat(info(0)), by_first, 1},
        {"mirrored coat", coat(info(0, 0, -1)), -by_first, -1},
        {"coat on the second set", coat(info(1)), by_second, 1},
        {"coat as the base", coat(info(0, 90)), none, 1},
        {"anisotropy", texture(info(1)), by_second, 1},
        {"anisotropy without a texture", merged(strength, base), by_first, 1},
        {"both", merged(coat(info(0)), texture(info(0, 0, 3))), by_first, 1},
        {"no base", merged(strength, coated({{"clearcoatFactor", 1}, {"clearcoatNormalTexture", info(1)}})),
         by_first, 1}};
    for (const auto& [what, material, expected, sign] : cases) {
        GltfFile f = mapped(material);
        const Scene scene = f.load();
        const Primitive& p = f.only(scene);
        EXPECT_EQ(turnedMaps(scene.materials.at(0), scene.materials[0].anisotropy > 0).layers != 0,
                  expected != none)
            << what;
        EXPECT_FALSE(mentions(scene.notes, "takes the tangents of the normal map")) << what;
        for (std::size_t v = 0; v < p.tangents.size(); ++v) {
            const glm::vec4 turned = turnedTangent(p.normals[v], p.tangents[v]);
            if (expected == none) {
                EXPECT_EQ(std::abs(p.tangents[v].w), 1) << what;
                continue;
            }
            EXPECT_LT(glm::distance(glm::vec3(turned), expected), 1e-6f) << what;
            EXPECT_EQ(turned.w, sign) << what;
        }
    }
    EXPECT_TRUE(mentions(mapped(merged(coat(info(1)), texture(info(0)))).load().notes,
                         "anisotropy takes the tangents of the normal map"));
    GltfFile turning = mapped(coat(info(1)));
    animate(turning,
            "KHR_materials_clearcoat/clearcoatNormalTexture/extensions/KHR_texture_transform/rotation", {0},
            {1});
    EXPECT_TRUE(mentions(turning.load().notes, "keep their angle to the normal map's"));
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
    animate(f, strength, {0}, {1});
    const Scene scene = f.load();
    ASSERT_EQ(scene.animations.size(), 1u);
    expectTangents(f.only(scene).tangents, {0, 1, 0}, strength);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0.5)).layers, gpu::LAYER_ANISOTROPY);
    GltfFile bare = withMaterial(brushed(Json::object()));
    animate(bare, strength, {0}, {1});
    EXPECT_TRUE(mentions(bare.load().notes, arbitrary));
}

// A factor that is 0 at rest keeps its textures, and adds its layer once it is not.
TEST(GltfLayers, AnimatedFactorsAddTheirLayerWhenTheyRise) {
    const Json info = {{"index", 0}};
    struct Case {
        Json material;
        const char* property;
        std::size_t width;
        gpu::uint slot, layer;
    };
    const Case cases[] = {
        {coated({{"clearcoatTexture", info}}), "KHR_materials_clearcoat/clearcoatFactor", 1,
         gpu::SLOT_clearcoat, gpu::LAYER_CLEARCOAT},
        {sheened({{"sheenColorTexture", info}}), "KHR_materials_sheen/sheenColorFactor", 3,
         gpu::SLOT_sheen_color, gpu::LAYER_SHEEN},
        {filmed({{"iridescenceThicknessTexture", info}}), "KHR_materials_iridescence/iridescenceFactor", 1,
         gpu::SLOT_iridescence_thickness, gpu::LAYER_IRIDESCENCE}};
    for (const Case& c : cases) {
        GltfFile f = mapped(c.material);
        animate(f, c.property, std::vector<float>(c.width, 0), std::vector<float>(c.width, 1));
        const Scene scene = f.load();
        EXPECT_TRUE(mayReadSlot(scene.materials.at(0), c.slot, true)) << c.property;
        EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u) << c.property;
        const Pose pose = poseAt(scene, 0.5);
        EXPECT_EQ(requirements(scene, pose).layers, c.layer) << c.property;
        EXPECT_TRUE(readsSlot(pose.materials.at(0), c.slot)) << c.property;
    }
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
        animate(f, fmt::format("{}/extensions/KHR_texture_transform/rotation", slot), {0},
                {std::numbers::pi_v<float>});
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
          "KHR_materials_clearcoat/clearcoatNormalTexture", "KHR_materials_anisotropy/anisotropyTexture",
          "KHR_materials_sheen/sheenColorTexture", "KHR_materials_sheen/sheenRoughnessTexture",
          "KHR_materials_iridescence/iridescenceTexture",
          "KHR_materials_iridescence/iridescenceThicknessTexture"}) {
        GltfFile f = mapped(
            merged(merged(coated({{"clearcoatFactor", 1}}), brushed({{"anisotropyStrength", 1}})),
                   merged(sheened({{"sheenColorFactor", {1, 1, 1}}}), filmed({{"iridescenceFactor", 1}}))));
        animate(f, fmt::format("{}/extensions/KHR_texture_transform/rotation", slot), {0}, {1});
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
        std::size_t coats, anisotropic, sheens, films;
        gpu::uint layers;
    };
    for (const Row& row :
         {Row{"ClearCoatTest/ClearCoatTest.glb", 6, 0, 0, 0, gpu::LAYER_CLEARCOAT},
          Row{"AnisotropyRotationTest/AnisotropyRotationTest.glb", 0, 4, 0, 0, gpu::LAYER_ANISOTROPY},
          // 7 x 7 balls, strength 0 in the first column
          Row{"AnisotropyStrengthTest/AnisotropyStrengthTest.glb", 0, 42, 0, 0, gpu::LAYER_ANISOTROPY},
          // 4 x 4 balls, colour 0 in the first row
          Row{"SheenTestGrid/SheenTestGrid.glb", 0, 0, 12, 0, gpu::LAYER_SHEEN},
          Row{"IridescenceLamp/IridescenceLamp.gltf", 0, 0, 0, 2,
              gpu::LAYER_IRIDESCENCE | gpu::LAYER_TRANSMISSION}}) {
        const Scene scene = loadScene((assets / row.file).string());
        std::size_t coats = 0, anisotropic = 0, sheens = 0, films = 0;
        for (const Material& m : scene.materials) {
            coats += m.clearcoat > 0;
            anisotropic += m.anisotropy > 0;
            sheens += m.sheen_color != glm::vec3(0);
            films += m.iridescence > 0;
        }
        EXPECT_EQ(coats, row.coats) << row.file;
        EXPECT_EQ(anisotropic, row.anisotropic) << row.file;
        EXPECT_EQ(sheens, row.sheens) << row.file;
        EXPECT_EQ(films, row.films) << row.file;
        EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, row.layers) << row.file;
        EXPECT_FALSE(mentions(scene.notes, "arbitrary")) << row.file;
    }
}
