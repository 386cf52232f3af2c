// SPDX-License-Identifier: MIT
#include "shared/image/limits.h"
#include "shared/scene/requirements.h"
#include "tests/unit/gltf_maker.h"

#include <array>
#include <cmath>
#include <tuple>
#include <utility>

using namespace diptych;
using Json = nlohmann::json;

TEST(GltfMaterial, MaterialsTexturesSamplersAndTransforms) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.json["images"] = {{{"uri", "missing.png"}},
                        {{"uri", twoPixels}, {"name", "two"}}};  // the first is read by nothing
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
    f.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
    f.json["materials"] = {{{"name", "glass"}, {"alphaMode", "BLEND"}}, {{"name", "plain"}}};
    const Scene scene = f.load();
    EXPECT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(f.only(scene).material, 2) << "the default material comes last";
    EXPECT_TRUE(mentions(scene.notes, "(glass) with alphaMode BLEND: drawn opaque"));
    EXPECT_TRUE(mentions(scene.notes, "KHR_materials_clearcoat"));
}

// Base colour, alpha and double-sidedness stay; the rest is ignored, its images are not even opened.
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

TEST(GltfMaterial, BrokenImagesInUseAreRefused) {
    for (const auto& [uri, expected] :
         {std::pair{"missing.png", "image 0: missing.png: no such file"},
          std::pair{"scene.gltf", "image 0 (scene.gltf): is neither PNG nor JPEG"},
          std::pair{"data:image/png;base64,iVBORw0KGgoAAAAN", "image 0: does not decode"}}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["material"] = 0;
        f.json["images"] = {{{"uri", uri}}};
        f.json["textures"] = {{{"source", 0}}};
        f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
        EXPECT_NE(f.error().find(expected), std::string::npos) << f.error();
        f.json["materials"][0]["emissiveTexture"]["index"] = 1;
        EXPECT_NE(f.error().find("material 0: emissiveTexture: index names texture 1"), std::string::npos)
            << f.error();
    }
}

TEST(GltfMaterial, ImagesInBufferViewsAreChecked) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    f.json["textures"] = {{{"source", 0}}};
    f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    EXPECT_NE(f.error().find("image 0: is neither"), std::string::npos) << f.error();
    f.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 30}, {"byteLength", 4000}});
    f.json["images"][0]["bufferView"] = 1;
    EXPECT_NE(f.error().find("bufferView 1: 4000 bytes from 30 on end past buffer 0 (36 bytes)"),
              std::string::npos)
        << f.error();
}

// ---- property by property ----------------------------------------------------------------------------

namespace {

// A file with one material; `images` PNGs of two pixels are textures 0 and up.
GltfFile withMaterial(Json material, int images = 1) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    for (int i = 0; i < images; ++i) {
        f.json["images"].push_back({{"uri", twoPixels}});
        f.json["textures"].push_back({{"source", i}});
    }
    f.json["materials"] = {std::move(material)};
    return f;
}

Material materialOf(Json material) {
    return withMaterial(std::move(material)).load().materials.at(0);
}

// The seven slots: how a file names each, and where it ends.
struct SlotCase {
    const char* name;
    Json (*material)(Json info);
    TextureSlot Material::*slot;
};

const SlotCase slotCases[] = {
    {"baseColorTexture",
     [](Json info) {
         return Json{{"pbrMetallicRoughness", {{"baseColorTexture", info}}}};
     },
     &Material::base_color_texture},
    {"metallicRoughnessTexture",
     [](Json info) {
         return Json{{"pbrMetallicRoughness", {{"metallicRoughnessTexture", info}}}};
     },
     &Material::metallic_roughness_texture},
    {"normalTexture",
     [](Json info) {
         return Json{{"normalTexture", info}};
     },
     &Material::normal_texture},
    {"occlusionTexture",
     [](Json info) {
         return Json{{"occlusionTexture", info}};
     },
     &Material::occlusion_texture},
    {"emissiveTexture",
     [](Json info) {
         return Json{{"emissiveTexture", info}};
     },
     &Material::emissive_texture},
    {"specularTexture",
     [](Json info) {
         return Json{{"extensions", {{"KHR_materials_specular", {{"specularTexture", info}}}}}};
     },
     &Material::specular_texture},
    {"specularColorTexture",
     [](Json info) {
         return Json{{"extensions", {{"KHR_materials_specular", {{"specularColorTexture", info}}}}}};
     },
     &Material::specular_color_texture},
};

Json transformed(Json transform, int texcoord = 0) {
    return {{"index", 0},
            {"texCoord", texcoord},
            {"extensions", {{"KHR_texture_transform", std::move(transform)}}}};
}

}  // namespace

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
    for (const SlotCase& c : slotCases) EXPECT_EQ((m.*c.slot).texture, -1) << c.name;
    for (const char* extension :
         {"KHR_materials_ior", "KHR_materials_specular", "KHR_materials_emissive_strength"}) {
        const Material same = materialOf({{"extensions", {{extension, Json::object()}}}});
        EXPECT_EQ(same.ior, 1.5f);
        EXPECT_EQ(same.specular, 1);
        EXPECT_EQ(same.specular_color, glm::vec3(1));
    }
}

// KHR_texture_transform: uv' = T R S uv with R = (cos, sin; -sin, cos); 30 degrees, exact to double.
TEST(GltfMaterial, EverySlotHasItsUvSetAndTransform) {
    for (const SlotCase& c : slotCases) {
        TextureSlot slot = materialOf(c.material({{"index", 0}})).*c.slot;
        EXPECT_EQ(slot.texture, 0) << c.name;
        EXPECT_EQ(slot.texcoord, 0) << c.name;
        EXPECT_EQ(slot.u, glm::dvec3(1, 0, 0)) << c.name;
        EXPECT_EQ(slot.v, glm::dvec3(0, 1, 0)) << c.name;
        EXPECT_EQ((materialOf(c.material({{"index", 0}, {"texCoord", 1}})).*c.slot).texcoord, 1) << c.name;

        slot = materialOf(c.material(transformed({{"offset", {0.25, -3}}}))).*c.slot;
        EXPECT_EQ(slot.u, glm::dvec3(1, 0, 0.25)) << c.name;
        EXPECT_EQ(slot.v, glm::dvec3(0, 1, -3)) << c.name;
        slot = materialOf(c.material(transformed({{"scale", {-2, 0}}}))).*c.slot;
        EXPECT_EQ(slot.u, glm::dvec3(-2, 0, 0)) << c.name;
        EXPECT_EQ(slot.v, glm::dvec3(0, 0, 0)) << c.name;
        const double angle = std::acos(std::sqrt(0.75));
        slot = materialOf(
                   c.material(transformed({{"rotation", angle}, {"scale", {2, 4}}, {"offset", {5, 6}}}, 1))).*
               c.slot;
        const glm::dvec3 u(2 * std::sqrt(0.75), 4 * 0.5, 5), v(-2 * 0.5, 4 * std::sqrt(0.75), 6);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(slot.u[i], u[i], 1e-12) << c.name << i;
            EXPECT_NEAR(slot.v[i], v[i], 1e-12) << c.name << i;
        }
        EXPECT_EQ(slot.texcoord, 1) << c.name << ": kept where the transform names none";
        EXPECT_EQ((materialOf(c.material(transformed({{"texCoord", 0}}, 1))).*c.slot).texcoord, 0) << c.name;
        EXPECT_EQ((materialOf(c.material(transformed({{"texCoord", 1}}, 7))).*c.slot).texcoord, 1) << c.name;
    }
}

TEST(GltfMaterial, TransformsBeyondAnyPictureAreNoted) {
    const Scene scene =
        withMaterial(slotCases[2].material(transformed({{"offset", {1e30, 0}}, {"scale", {1, -1e38}}})))
            .load();
    EXPECT_EQ(scene.materials[0].normal_texture.u, glm::dvec3(1, 0, 1e12));
    EXPECT_EQ(scene.materials[0].normal_texture.v, glm::dvec3(0, -1e12, 0));
    EXPECT_TRUE(mentions(
        scene.notes, "material 0: normalTexture offset 1e+30 is outside -1e+12 to 1e+12: taken as 1e+12"));
    EXPECT_TRUE(mentions(scene.notes, "material 0: normalTexture scale -1e+38 "));
}

TEST(GltfMaterial, AThirdUvSetIsLeftOutWithANote) {
    for (const SlotCase& c : slotCases)
        for (const Json& info : {Json{{"index", 0}, {"texCoord", 2}}, transformed({{"texCoord", 2}})}) {
            const Scene scene = withMaterial(c.material(info)).load();
            EXPECT_EQ((scene.materials[0].*c.slot).texture, -1) << c.name;
            EXPECT_TRUE(mentions(scene.notes, std::string("material 0: ") + c.name +
                                                  " reads TEXCOORD_2: left out, there are two UV sets"));
        }
}

TEST(GltfMaterial, EverySamplerMode) {
    const std::pair<int, Wrap> wraps[] = {
        {10497, Wrap::repeat}, {33648, Wrap::mirrored_repeat}, {33071, Wrap::clamp_to_edge}};
    const std::pair<int, bool> magnify[] = {{9728, false}, {9729, true}};
    const std::pair<int, std::array<bool, 3>> minify[] = {
        // linear, mipmaps, linear between them
        {9728, {false, false, false}}, {9729, {true, false, false}}, {9984, {false, true, false}},
        {9985, {true, true, false}},   {9986, {false, true, true}},  {9987, {true, true, true}}};
    GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
    f.json["textures"] = Json::array();
    std::vector<Sampler> expected;
    for (const auto& [s, wrapS] : wraps)
        for (const auto& [t, wrapT] : wraps)
            for (const auto& [mag, magLinear] : magnify)
                for (const auto& [min, how] : minify) {
                    f.json["textures"].push_back({{"source", 0}, {"sampler", expected.size()}});
                    f.json["samplers"].push_back(
                        {{"wrapS", s}, {"wrapT", t}, {"magFilter", mag}, {"minFilter", min}});
                    expected.push_back({wrapS, wrapT, magLinear, how[0], how[1], how[2]});
                }
    const Scene scene = f.load();
    ASSERT_EQ(expected.size(), 9u * 2 * 6);
    ASSERT_EQ(scene.textures.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(scene.textures[i].sampler, expected[i]) << i;
}

// Left open: repeat, linear, with mip levels.
TEST(GltfMaterial, SamplersThatAreLeftOpen) {
    GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
    f.json["samplers"] = {Json::object(), {{"magFilter", 9728}}, {{"wrapT", 33071}}};
    f.json["textures"] = {{{"source", 0}},
                          {{"source", 0}, {"sampler", 0}},
                          {{"source", 0}, {"sampler", 1}},
                          {{"source", 0}, {"sampler", 2}}};
    const Scene scene = f.load();
    constexpr Wrap r = Wrap::repeat;
    EXPECT_EQ(scene.textures[0].sampler, (Sampler{r, r, true, true, true, true}));
    EXPECT_EQ(scene.textures[1].sampler, (Sampler{r, r, true, true, true, true}));
    EXPECT_EQ(scene.textures[2].sampler, (Sampler{r, r, false, true, true, true}));
    EXPECT_EQ(scene.textures[3].sampler, (Sampler{r, Wrap::clamp_to_edge, true, true, true, true}));
}

TEST(GltfMaterial, ModesThatAreNoneAreRefused) {
    for (const auto& [key, value, expected] : {std::tuple{"wrapS", 10496, "sampler 0: 10496 is no wrap mode"},
                                               {"wrapT", 1, "sampler 0: 1 is no wrap mode"},
                                               {"magFilter", 9987, "sampler 0: 9987 is no magFilter"},
                                               {"minFilter", 9988, "sampler 0: 9988 is no minFilter"}}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
        f.json["samplers"] = {{{key, value}}};
        f.json["textures"][0]["sampler"] = 0;
        EXPECT_TRUE(f.error().ends_with(std::string(": ") + expected)) << f.error();
    }
}

// Numbers outside of what glTF allows are taken as the nearest inside, with a note that says so.
TEST(GltfMaterial, FactorsOutsideTheirRangeAreNoted) {
    struct Case {
        Json material;
        float (*value)(const Material&);
        float expected;
        const char* note;
    };
    const auto specular = [](Json s) { return Json{{"extensions", {{"KHR_materials_specular", s}}}}; };
    const Case cases[] = {
        {{{"pbrMetallicRoughness", {{"baseColorFactor", {-1, 0, 0, 1}}}}},
         [](const Material& m) { return m.base_color.r; },
         0,
         "material 0: baseColorFactor -1 is outside 0 to 1: taken as 0"},
        {{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 1e30, 1}}}}},
         [](const Material& m) { return m.base_color.b; },
         1,
         "material 0: baseColorFactor 1e+30 is outside 0 to 1: taken as 1"},
        {{{"pbrMetallicRoughness", {{"metallicFactor", 2}}}},
         [](const Material& m) { return m.metallic; },
         1,
         "metallicFactor 2 "},
        {{{"pbrMetallicRoughness", {{"roughnessFactor", -0.5}}}},
         [](const Material& m) { return m.roughness; },
         0,
         "roughnessFactor -0.5 "},
        {{{"occlusionTexture", {{"index", 0}, {"strength", 3}}}},
         [](const Material& m) { return m.occlusion_strength; },
         1,
         "occlusionTexture.strength 3 "},
        {{{"normalTexture", {{"index", 0}, {"scale", -1e38}}}},
         [](const Material& m) { return m.normal_scale; },
         -1e12f,
         "normalTexture.scale -1e+38 is outside -1e+12 to 1e+12"},
        {{{"emissiveFactor", {0, -2, 0}}},
         [](const Material& m) { return m.emissive.g; },
         0,
         "emissiveFactor -2 "},
        {{{"alphaMode", "MASK"}, {"alphaCutoff", -1}},
         [](const Material& m) { return m.alpha_cutoff; },
         0,
         "alphaCutoff -1 "},
        {{{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}},
         [](const Material& m) { return m.ior; },
         1,
         "material 0: ior 0.5 is neither 0 nor at least 1: taken as 1"},
        {{{"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", -1}}}}},
          {"emissiveFactor", {1, 1, 1}}},
         [](const Material& m) { return m.emissive.g; },
         0,
         "material 0: emissiveStrength -1 is outside 0 to "},
        // Printed with few digits it would be 1.
        {{{"pbrMetallicRoughness", {{"metallicFactor", 1.00000001}}}},
         [](const Material& m) { return m.metallic; },
         1,
         "metallicFactor 1.00000001 is outside 0 to 1: taken as 1"},
        {specular({{"specularFactor", 1.5}}), [](const Material& m) { return m.specular; }, 1,
         "specularFactor 1.5 "},
        {specular({{"specularColorFactor", {-1, 1, 1}}}),
         [](const Material& m) { return m.specular_color.r; }, 0, "specularColorFactor -1 "},
    };
    for (const Case& c : cases) {
        const Scene scene = withMaterial(c.material).load();
        EXPECT_EQ(c.value(scene.materials[0]), c.expected) << c.note;
        EXPECT_TRUE(mentions(scene.notes, c.note)) << c.note;
    }
}

// What glTF leaves unbounded stays as it is, without a note.
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
    EXPECT_TRUE(f.error().ends_with(": material 0: emits 1e+39, beyond any float")) << f.error();
}

// ---- images of other kinds ---------------------------------------------------------------------------

TEST(GltfMaterial, BasisuAndWebpAreRefusedByNameWhereRequired) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif"}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
        f.json["extensionsUsed"] = f.json["extensionsRequired"] = {name};
        EXPECT_TRUE(f.error().ends_with(std::string(": extensionsRequired: ") + name +
                                        " is not read: export the scene without it"))
            << f.error();
    }
}

// Where they are optional, a PNG or JPEG stands beside them; a material that has nothing else cannot be
// drawn.
TEST(GltfMaterial, FallbacksOfOtherImagesAreRead) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif"}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}});
        f.json["extensionsUsed"] = {name};
        f.json["images"].push_back({{"uri", "picture.ktx2"}});  // nobody opens it
        f.json["textures"][0]["extensions"] = {{name, {{"source", 1}}}};
        const Scene scene = f.load();
        EXPECT_TRUE(mentions(scene.notes, std::string(name) + ": left out, it is not read"));
        EXPECT_EQ(scene.images.size(), 1u);
        EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0);
        f.json["textures"][0].erase("source");
        EXPECT_TRUE(f.error().ends_with(
            std::string(": material 0: emissiveTexture: texture 0 has no image but that of ") + name +
            ", which is not read"))
            << f.error();
        f.primitive().erase("material");
        EXPECT_TRUE(mentions(f.load().notes, "which is not read: left out, nothing is drawn with it"));
    }
    GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}});
    f.json["textures"][0].erase("source");
    EXPECT_TRUE(mentions(f.load().notes,
                         "material 0: emissiveTexture: texture 0 has no PNG or JPEG image: left out"));
}

// Each image is far below the limit; together they are not.
TEST(GltfMaterial, AllImagesTogetherHaveALimit) {
    GltfFile f = withMaterial(Json::object(), 0);
    // A JPEG's header claims 16384 x 16384 of one component, 1 GiB decoded; zeros after it make it long
    // enough.
    std::vector<std::uint8_t> jpeg{0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 0x40, 0, 0x40, 0,  1, 1,
                                   0x11, 0,    0xff, 0xda, 0, 8,  1, 1,    0, 0,    63, 0};
    jpeg.resize(1 << 18);
    f.accessor<std::uint8_t>(jpeg, UBYTE, "SCALAR", 1);
    const int view = static_cast<int>(f.json["bufferViews"].size()) - 1;
    for (int i = 0; i < 65; ++i) {
        f.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/jpeg"}});
        f.json["textures"].push_back({{"source", i}});
        f.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
        f.json["meshes"][0]["primitives"].push_back(f.primitive());
        f.json["meshes"][0]["primitives"].back()["material"] = f.json["materials"].size() - 1;
    }
    const std::string most = std::to_string(limits::imageBytes() >> 20);
    EXPECT_TRUE(f.error().ends_with("MiB decoded: " + most + " MiB are read at most")) << f.error();
}
