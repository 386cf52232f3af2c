// SPDX-License-Identifier: MIT
#include "shared/scene/requirements.h"
#include "tests/unit/gltf_maker.h"

#include <cmath>

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
    EXPECT_TRUE(scene.notes.empty());
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
        f.json["images"] = {{{"uri", uri}}};
        f.json["textures"] = {{{"source", 0}}};
        f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
        EXPECT_NE(f.error().find(expected), std::string::npos) << f.error();
        f.json["materials"][0]["emissiveTexture"]["index"] = 1;
        EXPECT_NE(f.error().find("material 0: emissiveTexture: index names texture 1"), std::string::npos) << f.error();
    }
}

TEST(GltfMaterial, ImagesInBufferViewsAreChecked) {
    GltfFile f = GltfFile::triangle();
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
