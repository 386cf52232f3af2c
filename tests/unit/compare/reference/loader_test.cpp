// SPDX-License-Identifier: MIT
// The reference's results for glTF files, compared with values computed by hand. Both paths and the
// reference share the loader, so only this finds its faults.
#include "tests/support/gltf_builder.h"
#include "tests/support/png_builder.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

using Json = nlohmann::json;

// A square of 2 m at z = 0 that faces +Z. u runs along +X, v down; (0, 0) is the upper left corner.
GltfFile square(const Json& material = Json::object()) {
    GltfFile f;
    f.json["nodes"] = {{{"mesh", 0}}};
    const int positions = f.accessor<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, FLOAT, "VEC3", 3);
    const int normals = f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    const int uvs = f.accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, FLOAT, "VEC2", 2);
    const int indices = f.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, USHORT, "SCALAR", 1);
    f.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"indices", indices},
            {"material", 0}}}}}};
    Json whole = {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
    whole["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
    f.json["extensionsUsed"] = {"KHR_materials_specular"};
    whole.merge_patch(material);
    f.json["materials"] = nlohmann::json::array({whole});
    return f;
}

// Adds RGB pixels as texture 0, with nearest filtering.
void addTexture(GltfFile& f, std::uint32_t width, const std::vector<std::vector<std::uint8_t>>& rows) {
    std::ofstream(testFolder() / "texture.png", std::ios::binary) << pngOf({.width = width, .rows = rows});
    f.json["images"] = {{{"uri", "texture.png"}}};
    f.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}}};
    f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
}

// Four by four pixels of the square, from the front; (0, 0) is the upper left one.
Drawn front(const Scene& scene) {
    View view = viewFrom({0, 0, 3}, {0, 0, 0}, 4, 4);
    view.camera.orthographic = true;
    view.camera.ymag = 1;
    return drawn(scene, view);
}

glm::dvec3 at(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}
void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-6) {
    EXPECT_LT(glm::length(value - expected), tolerance) << value.x << " " << value.y << " " << value.z;
}

// ---- nodes -------------------------------------------------------------------------------------------

// A triangle with the normal (0, -1, 1) / sqrt(2). Stretching along y by 2 gives (0, -1, 2) / sqrt(5);
// rotating by -90 degrees around x, (x, y, z) to (x, z, -y), gives (0, 2, 1) / sqrt(5). Its centroid is
// (1/3, 1/3, -2/3).
TEST(ReferenceLoader, ANodeChainTurnsAndStretches) {
    GltfFile f;
    const double s = std::sqrt(0.5);
    const auto h = static_cast<float>(s);
    const int positions = f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 1}, FLOAT, "VEC3", 3);
    const int normals = f.accessor<float>({0, -h, h, 0, -h, h, 0, -h, h}, FLOAT, "VEC3", 3);
    const int colors = f.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f}, FLOAT, "VEC3", 3);
    f.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"COLOR_0", colors}}},
            {"material", 0}}}}}};
    f.json["materials"] = nlohmann::json::array(
        {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.5, 1, 1, 1}}}},
          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}});
    f.json["extensionsUsed"] = {"KHR_materials_specular", "KHR_lights_punctual"};
    f.json["nodes"] = {{{"children", {1, 2}}, {"rotation", {-s, 0, 0, s}}},
                       {{"mesh", 0}, {"scale", {1, 2, 1}}},
                       {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"scale", {5, 5, 5}}}};
    // The light shines along its node's -Z, here rotated to -Y.
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 2}, {"color", {1, 0.5, 0.25}}}};
    const glm::dvec3 position(1.0 / 3, 1.0 / 3, -2.0 / 3);
    const Drawn d = drawn(f.load(), viewFrom(position + glm::dvec3(0, 4, 0), position, 1, 1, 0.01));
    expectNear(at(d[Channel::normals], 0, 0), glm::dvec3(0, 2, 1) / std::sqrt(5.0));
    expectNear(at(d[Channel::geometric_normal], 0, 0), glm::dvec3(0, 2, 1) / std::sqrt(5.0));
    EXPECT_NEAR(double{d[Channel::depth].at(0, 0)}, 4, 1e-6);
    expectNear(at(d[Channel::albedo], 0, 0), glm::dvec3(0.5 / 3, 1.0 / 3, 0.5 / 3));
    const double e = 2 * 2 / std::sqrt(5.0) / pi;
    expectNear(at(d[Channel::lit], 0, 0), e * glm::dvec3(0.5 / 3, 0.5 / 3, 0.125 / 3));
}

// ---- lights ------------------------------------------------------------------------------------------

// 8 cd, 2 m in front of the square. At (0.25, 0.25) d^2 = 4.125; the cosine 2 / d counts twice, at the
// surface and from the light's axis.
TEST(ReferenceLoader, ASpotInItsUnits) {
    GltfFile f = square();
    f.json["extensionsUsed"].push_back("KHR_lights_punctual");
    f.json["nodes"][0]["children"] = {1};
    f.json["nodes"].push_back(
        {{"translation", {0, 0, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"intensity", 8},
         {"range", 4},
         {"spot", {{"innerConeAngle", 0.125}, {"outerConeAngle", 0.5}}}}};
    const Drawn d = front(f.load());
    const double square_of = 4.125, cosine = 2 / std::sqrt(square_of);
    const double inside = (cosine - std::cos(0.5)) / (std::cos(0.125) - std::cos(0.5));
    const double window = 1 - std::pow(square_of / 16, 2);
    const double expected = 8 / square_of * cosine * inside * inside * window / pi;
    for (const int x : {1, 2})
        for (const int y : {1, 2})
            EXPECT_NEAR(double{d[Channel::lit].at(x, y, 1)}, expected, 1e-6 * expected);
    // The cone's edge is at tan(0.5) 2 = 1.09 m, the corner pixels' centres at 1.06 m.
    EXPECT_GT(d[Channel::lit].at(0, 0, 1), 0);
    EXPECT_LT(d[Channel::lit].at(0, 0, 1), 0.01f);
}

TEST(ReferenceLoader, AnAreaLightOfExtras) {
    GltfFile f = square();
    f.json["nodes"].push_back({{"translation", {0, 0, 2}}});
    f.json["scenes"][0]["nodes"] = {0, 1};
    f.json["scenes"][0]["extras"]["diptych"]["lights"] = {
        {{"type", "rect"}, {"node", 1}, {"size", {3, 1}}, {"intensity", 10}}};
    const Drawn d = front(f.load());
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const glm::dvec3 position(-0.75 + 0.5 * x, 0.75 - 0.5 * y, 0);
            const std::vector<glm::dvec3> corners{
                glm::dvec3(-1.5, -0.5, 2) - position, glm::dvec3(1.5, -0.5, 2) - position,
                glm::dvec3(1.5, 0.5, 2) - position, glm::dvec3(-1.5, 0.5, 2) - position};
            const double expected = 10 * lambertIrradiance(corners, {0, 0, 1}) / pi;
            EXPECT_NEAR(double{d[Channel::lit].at(x, y, 1)}, expected, 1e-6 * expected);
        }
}

// ---- textures ----------------------------------------------------------------------------------------

// Rows 255 0 0 | 0 128 0 and 0 0 55 | 255 255 255. IEC 61966-2-1: 128 is 0.215861, 55 is 0.038204.
TEST(ReferenceLoader, ATexturesFirstRowIsOnTop) {
    GltfFile f = square({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    addTexture(f, 2, {{255, 0, 0, 0, 128, 0}, {0, 0, 55, 255, 255, 255}});
    const Drawn d = front(f.load());
    const Image& albedo = d[Channel::albedo];
    for (const int i : {0, 1}) {
        expectNear(at(albedo, i, i), {1, 0, 0});
        expectNear(at(albedo, 2 + i, i), {0, 0.2158605, 0});
        expectNear(at(albedo, i, 2 + i), {0, 0, 0.0382044});
        expectNear(at(albedo, 2 + i, 2 + i), {1, 1, 1});
    }
}

// Roughness in green, metallic in blue, occlusion in red, all linear.
TEST(ReferenceLoader, TheOrderOfMetallicAndRoughness) {
    const Json slot = {{"index", 0}};
    Json occlusion = slot;
    occlusion["strength"] = 0.5;
    GltfFile f =
        square({{"pbrMetallicRoughness",
                 {{"metallicRoughnessTexture", slot}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
                {"occlusionTexture", occlusion}});
    addTexture(f, 1, {{51, 102, 204}});
    const Drawn d = front(f.load());
    EXPECT_NEAR(double{d[Channel::roughness].at(1, 1)}, 0.4 * 0.25, 1e-7);
    EXPECT_NEAR(double{d[Channel::metallic].at(1, 1)}, 0.8 * 0.5, 1e-7);
    EXPECT_NEAR(double{d[Channel::occlusion].at(1, 1)}, 1 + 0.5 * (0.2 - 1), 1e-7);
}

TEST(ReferenceLoader, EmissionHasAStrength) {
    GltfFile f = square({{"emissiveFactor", {1, 0.5, 0}},
                         {"emissiveTexture", {{"index", 0}}},
                         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}}}}});
    f.json["extensionsUsed"].push_back("KHR_materials_emissive_strength");
    addTexture(f, 1, {{128, 255, 255}});
    expectNear(at(front(f.load())[Channel::emission], 1, 1), {20 * 0.2158605, 10, 0}, 1e-5);
}

// Red points along u, green to the texture's top, here +Y (glTF 2.0, 3.9.3).
TEST(ReferenceLoader, ANormalMapsRedIsRightAndGreenIsUp) {
    const auto normalOf = [](const std::vector<std::uint8_t>& pixel, double scale) {
        GltfFile f = square({{"normalTexture", {{"index", 0}, {"scale", scale}}}});
        addTexture(f, 1, {pixel});
        return at(front(f.load())[Channel::normals], 1, 1);
    };
    const auto unpacked = [](int code) { return 2 * code / 255.0 - 1; };
    for (const double scale : {1.0, 0.5}) {
        const double x = unpacked(204) * scale, y = unpacked(153) * scale, z = unpacked(230);
        expectNear(normalOf({204, 153, 230}, scale), glm::normalize(glm::dvec3(x, y, z)));
    }
    expectNear(normalOf({51, 153, 230}, 1),
               glm::normalize(glm::dvec3(unpacked(51), unpacked(153), unpacked(230))));
}

}  // namespace
}  // namespace diptych::reference
