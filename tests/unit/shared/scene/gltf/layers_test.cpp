// SPDX-License-Identifier: MIT
// Layers of materials: every factor and texture of layer_table.h, tangents, animation.
#include "shared/scene/gltf/properties.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"
#include "shared/scene/motion/posed.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_material_builder.h"
#include "tests/support/layer_table.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// A layer, a slot or a factor without a row of layer_table.h would have no test.
TEST(LayerTable, HasAllOfTheContractAndOfTheSchema) {
    std::set<gpu::uint> bits, slots;
    std::set<AnimatedPart> weights, parts;
    for (const TestedLayer& layer : testedLayers()) {
        bits.insert(layer.bit);
        weights.insert(layer.factors[0].part);
        for (const LayerFactor& f : layer.factors) parts.insert(f.part);
        for (const LayerTexture& t : layer.textures) slots.insert(t.slot);
    }
#define LAYER_ROW(name, bit, factor) EXPECT_TRUE(bits.contains(bit)) << #name;
    MATERIAL_LAYERS(LAYER_ROW)
#define SLOT_ROW(number, name, colors, reads, layer, factor, words) \
    EXPECT_TRUE(gpu::LAYER_##layer == gpu::LAYER_BASE || slots.contains(number)) << #name;
    MATERIAL_SLOTS(SLOT_ROW)
    for (const gltf::schema::Property& extension : gltf::schema::materialExtensions) {
        if (extension.properties.empty() || !weights.contains(*extension.properties[0].part)) continue;
        for (const gltf::schema::Property& p : extension.properties)
            EXPECT_TRUE(p.part ? parts.contains(*p.part) : slots.contains(static_cast<gpu::uint>(p.slot)))
                << p.key;
    }
}

Json coated(Json coat) {
    return Json{{"extensions", {{"KHR_materials_clearcoat", std::move(coat)}}}};
}
Json brushed(Json anisotropy) {
    return Json{{"extensions", {{"KHR_materials_anisotropy", std::move(anisotropy)}}}};
}
Json sheened(Json sheen) {
    return Json{{"extensions", {{"KHR_materials_sheen", std::move(sheen)}}}};
}
Json merged(Json a, const Json& b) {
    a.merge_patch(b);
    return a;
}

// One triangle in z = 0. By TEXCOORD_0, u grows along +Y; by TEXCOORD_1, along -X.
GltfFile mapped(Json material, int images = 1) {
    GltfFile f = withMaterial(std::move(material), images);
    f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor<float>({0, 0, 0, 1, 1, 0}, FLOAT, "VEC2", 2);
    f.primitive()["attributes"]["TEXCOORD_1"] = f.accessor<float>({1, 0, 0, 0, 1, 1}, FLOAT, "VEC2", 2);
    return f;
}

void expectTangents(const std::vector<glm::vec4>& tangents, const glm::vec3& expected, const char* what) {
    ASSERT_FALSE(tangents.empty()) << what;
    for (const glm::vec4& t : tangents) EXPECT_LT(glm::distance(glm::vec3(t), expected), 1e-6f) << what;
}

constexpr const char* arbitrary = "direction of anisotropy is arbitrary: no tangents, no texture coordinates";

}  // namespace

// ---- every layer -------------------------------------------------------------------------------------

class GltfLayer : public testing::TestWithParam<TestedLayer> {
protected:
    template <class Part>
    static std::string extensionOf(const Part& part) {
        return std::string("KHR_materials_") + part.extension;
    }
    static Json numbersOf(const LayerFactor& factor, const glm::vec3& value) {
        if (factor.width() == 1) return value.x;
        return {value.r, value.g, value.b};
    }
    // Every factor, and texture 0, 1 ... by alternating sets of coordinates.
    static Json written() {
        Json material;
        for (const LayerFactor& f : GetParam().factors)
            material["extensions"][extensionOf(f)][f.key] = numbersOf(f, f.typical);
        int index = 0;
        for (const LayerTexture& t : GetParam().textures) {
            material["extensions"][extensionOf(t)][t.key] = {{"index", index}, {"texCoord", index % 2}};
            ++index;
        }
        return material;
    }
    template <class Part>
    static Json with(const Part& part, const Json& value) {
        Json material = written();
        material["extensions"][extensionOf(part)][part.key] = value;
        return material;
    }
    static GltfFile file(const Json& material) { return mapped(material, 3); }

    static void expectNone(const Material& m) {
        for (const LayerFactor& f : GetParam().factors) EXPECT_EQ(f.of(m), f.initial) << f.key;
        for (const LayerTexture& t : GetParam().textures) EXPECT_EQ(t.of(m).texture, -1) << t.key;
        EXPECT_EQ(layersOf(m), 0u);
    }
};

TEST_P(GltfLayer, FactorsAndTexturesAreRead) {
    const Scene scene = file(written()).load();
    const Material& m = scene.materials.at(0);
    for (const LayerFactor& f : GetParam().factors) EXPECT_EQ(f.of(m), f.typical) << f.key;
    int index = 0;
    for (const LayerTexture& t : GetParam().textures) {
        EXPECT_EQ(t.of(m).texture, index) << t.key;
        EXPECT_EQ(t.of(m).texcoord, index % 2) << t.key;
        ++index;
    }
    EXPECT_EQ(scene.images.size(), GetParam().textures.size());
    EXPECT_EQ(layersOf(m), GetParam().bit);
    EXPECT_EQ(blends(m), GetParam().bit == gpu::LAYER_TRANSMISSION);
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "nothing is left out";
}

TEST_P(GltfLayer, DefaultsAreNone) {
    Json empty = written(), factor = empty;
    for (Json& extension : empty["extensions"]) extension = Json::object();
    expectNone(materialOf(Json::object()));
    expectNone(materialOf(empty));
    const LayerFactor& first = GetParam().factors[0];
    factor["extensions"][extensionOf(first)].erase(first.key);
    EXPECT_EQ(layersOf(file(factor).load().materials.at(0)), 0u) << "whatever else is given";
}

TEST_P(GltfLayer, RequiredExtensionsAreSupported) {
    GltfFile f = file(written());
    for (const auto& extension : written()["extensions"].items())
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            f.json[list].push_back(extension.key());
    EXPECT_EQ(f.error(), "");
}

TEST_P(GltfLayer, FactorsOutsideTheirRangeAreNoted) {
    for (const LayerFactor& f : GetParam().factors)
        for (const double x : {f.min - 1, 0.0, 2 * f.max}) {
            const double nearest = std::clamp(x, f.min, f.max);
            if (!std::isfinite(x) || x == nearest) continue;
            const Scene scene = file(with(f, f.width() == 1 ? Json(x) : Json({0.25, 0.5, x}))).load();
            const auto used = static_cast<float>(nearest);
            EXPECT_EQ(f.of(scene.materials.at(0)),
                      f.width() == 1 ? glm::vec3(used, 0, 0) : glm::vec3(0.25f, 0.5f, used))
                << f.key;
            const std::string note = fmt::format("material 0: {} {} is outside {:g} to {:g}: {:g} is used",
                                                 f.key, x, f.min, f.max, nearest);
            EXPECT_TRUE(mentions(scene.notes, note)) << note;
        }
}

TEST_P(GltfLayer, WrongTypesAreRefused) {
    for (const LayerFactor& f : GetParam().factors)
        for (const Json& wrong : {Json("all"), Json::array({1, 1}), Json::array({1, 1, 1, 1})})
            EXPECT_NE(file(with(f, wrong)).error(), "") << f.key << " " << wrong;
    for (const LayerTexture& t : GetParam().textures)
        for (const Json& wrong : {Json{{"index", 7}}, Json::object()})
            EXPECT_NE(file(with(t, wrong)).error(), "") << t.key << " " << wrong;
}

TEST_P(GltfLayer, UnlitMaterialsHaveNone) {
    Json material = written();
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const Scene scene = file(material).load();
    EXPECT_TRUE(scene.materials.at(0).unlit);
    expectNone(scene.materials[0]);
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
}

// A factor that is 0 at rest keeps its textures, and adds its layer once it is not.
TEST_P(GltfLayer, AnAnimatedFactorAddsItWhenItRises) {
    const LayerFactor& first = GetParam().factors[0];
    GltfFile f = file(with(first, numbersOf(first, glm::vec3(0))));
    std::vector<float> values(2 * first.width(), 0);
    std::fill_n(values.rbegin(), first.width(), 1.0f);
    animate(f, "extensions/" + extensionOf(first) + "/" + first.key, values);
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0.5);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
    EXPECT_EQ(requirements(scene, pose).layers, GetParam().bit);
    for (const LayerTexture& t : GetParam().textures) {
        EXPECT_TRUE(mayReadSlot(scene.materials.at(0), t.slot, true)) << t.key;
        EXPECT_FALSE(readsSlot(scene.materials[0], t.slot)) << t.key;
        EXPECT_TRUE(readsSlot(pose.materials.at(0), t.slot)) << t.key;
    }
    EXPECT_FALSE(mentions(scene.notes, "KHR_materials")) << "every extension has an effect";
}

TEST_P(GltfLayer, TransformsOfMissingTexturesAreNotAnimated) {
    for (const LayerTexture& t : GetParam().textures) {
        Json material = written();
        material["extensions"][extensionOf(t)].erase(t.key);
        GltfFile f = file(material);
        animate(
            f,
            fmt::format("extensions/{}/{}/extensions/KHR_texture_transform/rotation", extensionOf(t), t.key),
            {0, 1});
        const Scene scene = f.load();
        EXPECT_TRUE(scene.animations.empty()) << t.key;
        EXPECT_TRUE(mentions(scene.notes, "the material has no such texture")) << t.key;
    }
}

INSTANTIATE_TEST_SUITE_P(Layers, GltfLayer, testing::ValuesIn(testedLayers()), layerName);

// ---- one layer ---------------------------------------------------------------------------------------

TEST(GltfLayers, ACoatsNormalsHaveAScale) {
    const auto scaled = [](double scale) {
        return withMaterial(coated({{"clearcoatNormalTexture", {{"index", 0}, {"scale", scale}}}})).load();
    };
    EXPECT_EQ(Material().clearcoat_normal_scale, 1);
    EXPECT_EQ(scaled(-2).materials.at(0).clearcoat_normal_scale, -2);
    const Scene large = scaled(1e30);
    EXPECT_EQ(large.materials.at(0).clearcoat_normal_scale, 1e12f);
    EXPECT_TRUE(mentions(large.notes, "material 0: clearcoatNormalTexture.scale 1e+30 "));
}

// One component of the colour is a sheen.
TEST(GltfLayers, ASheenOfOneComponentIsALayer) {
    for (int c = 0; c < 3; ++c) {
        std::vector<double> color(3, 0.0);
        color[static_cast<std::size_t>(c)] = 0.01;
        EXPECT_EQ(layersOf(materialOf(sheened({{"sheenColorFactor", color}}))), gpu::LAYER_SHEEN) << c;
    }
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
        EXPECT_EQ(rotatedMaps(scene.materials.at(0), scene.materials[0].anisotropy > 0).layers != 0,
                  expected != none)
            << what;
        EXPECT_FALSE(mentions(scene.notes, "takes the tangents of the normal map")) << what;
        for (std::size_t v = 0; v < p.tangents.size(); ++v) {
            const glm::vec4 turned = rotatedTangent(p.normals[v], p.tangents[v]);
            if (expected == none) {
                EXPECT_EQ(std::abs(p.tangents[v].w), 1) << what;
                continue;
            }
            EXPECT_LT(glm::distance(glm::vec3(turned), expected), 1e-6f) << what;
            EXPECT_EQ(turned.w, sign) << what;
        }
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

TEST(GltfLayers, AnisotropyWithoutTangentsAndCoordinatesHasSome) {
    const Scene scene = withMaterial(brushed({{"anisotropyStrength", 0.5}})).load();
    for (const glm::vec4& t : scene.meshes.at(0).primitives.at(0).tangents)
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
}

// ---- animation ---------------------------------------------------------------------------------------

// A material that is isotropic at rest has tangents for the time when it is not.
TEST(GltfLayers, AnimatedStrengthNeedsTangentsFromTheStart) {
    const char* const strength = "extensions/KHR_materials_anisotropy/anisotropyStrength";
    GltfFile f = mapped(brushed(Json::object()));
    animate(f, strength, {0, 1});
    const Scene scene = f.load();
    ASSERT_EQ(scene.animations.size(), 1u);
    expectTangents(f.only(scene).tangents, {0, 1, 0}, strength);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0)).layers, 0u);
    EXPECT_EQ(requirements(scene, poseAt(scene, 0.5)).layers, gpu::LAYER_ANISOTROPY);
    GltfFile bare = withMaterial(brushed(Json::object()));
    animate(bare, strength, {0, 1});
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
        animate(f, fmt::format("extensions/{}/extensions/KHR_texture_transform/rotation", slot),
                {0, std::numbers::pi_v<float>});
        const Scene scene = f.load();
        const Pose pose = poseAt(scene, 1);
        ASSERT_EQ(pose.instances.size(), 1u);
        EXPECT_EQ(pose.instances[0].map_rotated, sign < 0) << slot;
        for (const glm::dvec3& t : posedVertices(scene, pose, pose.instances[0]).tangents)
            EXPECT_LT(glm::distance(t, glm::dvec3(0, sign, 0)), 1e-6) << slot;
    }
}

// ---- files -------------------------------------------------------------------------------------------

TEST(GltfLayers, RealFilesHaveTheirLayers) {
    const std::filesystem::path assets = DIPTYCH_SOURCE_DIR "/../shared/assets/layered";
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": real files are not tried";
    using Counts = std::map<std::string, std::ptrdiff_t>;  // of materials with a layer
    const std::pair<const char*, Counts> files[] = {
        {"ClearCoatTest/ClearCoatTest.glb", {{"clearcoat", 6}}},
        {"AnisotropyRotationTest/AnisotropyRotationTest.glb", {{"anisotropy", 4}}},
        // 7 x 7 balls, strength 0 in the first column
        {"AnisotropyStrengthTest/AnisotropyStrengthTest.glb", {{"anisotropy", 42}}},
        // 4 x 4 balls, colour 0 in the first row
        {"SheenTestGrid/SheenTestGrid.glb", {{"sheen", 12}}},
        {"IridescenceLamp/IridescenceLamp.gltf", {{"iridescence", 2}, {"transmission", 1}}}};
    for (const auto& [file, expected] : files) {
        const Scene scene = loadScene((assets / file).string());
        Counts counts;
        for (const TestedLayer& layer : testedLayers())
            for (const Material& m : scene.materials)
                if ((layersOf(m) & layer.bit) != 0) ++counts[layer.name];
        EXPECT_EQ(counts, expected) << file;
        EXPECT_FALSE(mentions(scene.notes, "arbitrary")) << file;
    }
}
