// SPDX-License-Identifier: MIT
// Textures of materials: slots, samplers, transforms, images.
#include "shared/image/limits.h"
#include "tests/fuzz/base64.h"
#include "tests/support/gltf_material_builder.h"
#include "tests/support/layer_table.h"
#include "tests/support/webp_builder.h"

#include <array>
#include <cmath>
#include <tuple>
#include <utility>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// The slots: each with its object in a material, its name there and its member in Material.
struct SlotCase {
    std::string in, name;
    TextureSlot Material::*slot;
    Json material(const Json& info) const {
        Json made;
        made[Json::json_pointer(in + "/" + name)] = info;
        return made;
    }
};

const std::vector<SlotCase>& slotCases() {
    static const std::vector<SlotCase> cases = [] {
        const std::string metal = "/pbrMetallicRoughness", extensions = "/extensions/KHR_materials_",
                          specular = extensions + "specular", gloss = extensions + "pbrSpecularGlossiness";
        std::vector<SlotCase> all{{metal, "baseColorTexture", &Material::base_color_texture},
                                  {metal, "metallicRoughnessTexture", &Material::metallic_roughness_texture},
                                  {"", "normalTexture", &Material::normal_texture},
                                  {"", "occlusionTexture", &Material::occlusion_texture},
                                  {"", "emissiveTexture", &Material::emissive_texture},
                                  {specular, "specularTexture", &Material::specular_texture},
                                  {specular, "specularColorTexture", &Material::specular_color_texture},
                                  {gloss, "diffuseTexture", &Material::base_color_texture},
                                  {gloss, "specularGlossinessTexture", &Material::specular_color_texture}};
        for (const TestedLayer& layer : testedLayers())
            for (const LayerTexture& t : layer.textures)
                all.push_back({extensions + t.extension, t.key, materialSlots[t.slot].texture});
        return all;
    }();
    return cases;
}

Json transformed(Json transform, int texcoord = 0) {
    return {{"index", 0},
            {"texCoord", texcoord},
            {"extensions", {{"KHR_texture_transform", std::move(transform)}}}};
}

}  // namespace

// ---- slots -------------------------------------------------------------------------------------------

// KHR_texture_transform: uv' = T R S uv with R = (cos, sin; -sin, cos); 30 degrees, exact to double.
TEST(GltfTexture, EverySlotHasItsUvSetAndTransform) {
    for (const SlotCase& c : slotCases()) {
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

TEST(GltfTexture, TransformsBeyondAnyImageAreNoted) {
    const Scene scene =
        withMaterial(slotCases()[2].material(transformed({{"offset", {1e30, 0}}, {"scale", {1, -1e38}}})))
            .load();
    EXPECT_EQ(scene.materials[0].normal_texture.u, glm::dvec3(1, 0, 1e12));
    EXPECT_EQ(scene.materials[0].normal_texture.v, glm::dvec3(0, -1e12, 0));
    EXPECT_TRUE(mentions(scene.notes,
                         "material 0: normalTexture offset 1e+30 is outside -1e+12 to 1e+12: 1e+12 is used"));
    EXPECT_TRUE(mentions(scene.notes, "material 0: normalTexture scale -1e+38 "));
}

TEST(GltfTexture, AThirdUvSetIsLeftOutWithANote) {
    for (const SlotCase& c : slotCases())
        for (const Json& info : {Json{{"index", 0}, {"texCoord", 2}}, transformed({{"texCoord", 2}})}) {
            const Scene scene = withMaterial(c.material(info)).load();
            EXPECT_EQ((scene.materials[0].*c.slot).texture, -1) << c.name;
            EXPECT_TRUE(mentions(
                scene.notes,
                "material 0: " + c.name + " reads TEXCOORD_2: left out, only two UV sets are supported"));
        }
}

TEST(GltfTexture, EverySamplerMode) {
    const std::pair<int, Wrap> wraps[] = {
        {10497, Wrap::repeat}, {33648, Wrap::mirrored_repeat}, {33071, Wrap::clamp_to_edge}};
    const std::pair<int, bool> magnify[] = {{9728, false}, {9729, true}};
    const std::pair<int, std::array<bool, 3>> minify[] = {
        // linear filter, mipmaps, linear between mip levels
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

// If the file gives no filters: repeat, linear, with mip levels.
TEST(GltfTexture, SamplersThatAreLeftOpen) {
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

TEST(GltfTexture, ModesThatAreNoneAreRefused) {
    for (const auto& [key, value, expected] :
         {std::tuple{"wrapS", 10496, "sampler 0: 10496 is not a wrap mode"},
          {"wrapT", 1, "sampler 0: 1 is not a wrap mode"},
          {"magFilter", 9987, "sampler 0: 9987 is not a magFilter"},
          {"minFilter", 9988, "sampler 0: 9988 is not a minFilter"}}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
        f.json["samplers"] = {{{key, value}}};
        f.json["textures"][0]["sampler"] = 0;
        EXPECT_TRUE(f.error().ends_with(std::string(": ") + expected)) << f.error();
    }
}

// ---- images ------------------------------------------------------------------------------------------

TEST(GltfTexture, BrokenImagesInUseAreRefused) {
    for (const auto& [uri, expected] :
         {std::pair{"missing.png", "image 0: missing.png: no such file"},
          std::pair{"scene.gltf", "image 0 (scene.gltf): is not PNG, JPEG or WebP"},
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

TEST(GltfTexture, ImagesInBufferViewsAreChecked) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    f.json["textures"] = {{{"source", 0}}};
    f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    EXPECT_NE(f.error().find("image 0: is not PNG, JPEG or WebP"), std::string::npos) << f.error();
    f.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 30}, {"byteLength", 4000}});
    f.json["images"][0]["bufferView"] = 1;
    EXPECT_NE(f.error().find("bufferView 1: 4000 bytes at offset 30 end past buffer 0 (36 bytes)"),
              std::string::npos)
        << f.error();
}

TEST(GltfTexture, BasisuAndAvifAreRefusedByNameWhereRequired) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif"}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
        f.json["extensionsUsed"] = f.json["extensionsRequired"] = {name};
        EXPECT_TRUE(f.error().ends_with(std::string(": extensionsRequired: ") + name +
                                        " is not supported; export the scene without it"))
            << f.error();
    }
}

// If such an extension is optional, a PNG or JPEG is the fallback. A texture without a fallback makes its
// material undrawable.
TEST(GltfTexture, FallbacksOfOtherImagesAreRead) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif"}) {
        GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}});
        f.json["extensionsUsed"] = {name};
        f.json["images"].push_back({{"uri", "picture.ktx2"}});  // never opened
        f.json["textures"][0]["extensions"] = {{name, {{"source", 1}}}};
        const Scene scene = f.load();
        EXPECT_TRUE(mentions(scene.notes, std::string(name) + ": left out, not supported"));
        EXPECT_EQ(scene.images.size(), 1u);
        EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0);
        f.json["textures"][0].erase("source");
        EXPECT_TRUE(f.error().ends_with(
            std::string(": material 0: emissiveTexture: texture 0 has only an image of ") + name +
            ", which is not supported"))
            << f.error();
        f.primitive().erase("material");
        EXPECT_TRUE(mentions(f.load().notes, "which is not supported: left out, the scene does not use it"));
    }
    GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}});
    f.json["textures"][0].erase("source");
    EXPECT_TRUE(mentions(f.load().notes,
                         "material 0: emissiveTexture: texture 0 has no PNG, JPEG or WebP image: left out"));
}

// EXT_texture_webp: its image is used, also where a PNG is the fallback. A file, a data URI and a bufferView
// hold the same image.
TEST(GltfTexture, WebpImagesReplaceTheirFallbacks) {
    const WebpPixels written = colourfulWebp(3, 2, false);
    const std::string webp = losslessWebp(written);
    for (const bool fallback : {false, true})
        for (const char* where : {"file", "data", "view"}) {
            GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
            f.json["extensionsUsed"] = f.json["extensionsRequired"] = Json::array({"EXT_texture_webp"});
            if (where == std::string("file")) {
                std::ofstream(testFolder() / "a picture.webp", std::ios::binary) << webp;
                f.json["images"].push_back({{"uri", "a%20picture.webp"}});
            } else if (where == std::string("data")) {
                f.json["images"].push_back({{"uri", "data:image/webp;base64," + fuzz::base64(webp)}});
            } else {
                f.accessor<char>({webp.begin(), webp.end()}, BYTE, "SCALAR", 1);
                f.json["images"].push_back(
                    {{"bufferView", f.json["bufferViews"].size() - 1}, {"mimeType", "image/webp"}});
            }
            f.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
            if (!fallback) f.json["textures"][0].erase("source");
            const Scene scene = f.load();
            EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0) << where;
            ASSERT_EQ(scene.images.size(), 1u) << where << ": the fallback is not read";
            EXPECT_EQ(scene.images[0].width, 3) << where;
            EXPECT_EQ(scene.images[0].rgba, written.rgba) << where;
        }
}

TEST(GltfTexture, BrokenWebpImagesAreRefused) {
    GltfFile f = withMaterial({{"emissiveTexture", {{"index", 0}}}});
    f.json["extensionsUsed"] = Json::array({"EXT_texture_webp"});
    f.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
    EXPECT_NE(f.error().find("texture 0: EXT_texture_webp: source names image 1, but the file has 1"),
              std::string::npos)
        << f.error();
    const std::string still = losslessWebp(colourfulWebp(3, 2, false));
    for (const auto& [webp, expected] :
         {std::pair{still.substr(0, 18), "image 1: does not decode: it ends early"},
          {animatedWebp(colourfulWebp(3, 2, false)),
           "image 1: is an animated WebP, which is not supported; use a still image"}}) {
        f.json["images"][1] = {{"uri", "data:image/webp;base64," + fuzz::base64(webp)}};
        EXPECT_TRUE(f.error().ends_with(expected)) << f.error();
    }
    f.json["textures"][0]["extensions"]["EXT_texture_webp"] = Json::object();
    EXPECT_EQ(f.load().images.at(0).width, 2) << "without a source, the fallback is read";
}

// Each image is far below the limit, but together they exceed it.
TEST(GltfTexture, AllImagesTogetherHaveALimit) {
    GltfFile f = withMaterial(Json::object(), 0);
    // A JPEG whose header claims 16384 x 16384 pixels of one component, 1 GiB decoded. Zeros make the file
    // long enough.
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
    const std::string max = std::to_string(limits::imageBytes() >> 20);
    EXPECT_TRUE(f.error().ends_with("MiB; the limit is " + max + " MiB")) << f.error();
}
