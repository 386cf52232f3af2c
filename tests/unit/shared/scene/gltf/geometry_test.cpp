// SPDX-License-Identifier: MIT
#include "shared/scene/motion/bounds.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

TEST(GltfGeometry, TriangleWithoutNormalsIsFlatWithATangentAndADefaultMaterial) {
    GltfFile f = GltfFile::triangle();
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    for (std::size_t v = 0; v < 3; ++v) {
        EXPECT_EQ(p.normals[v], glm::vec3(0, 0, 1));
        EXPECT_NEAR(glm::dot(glm::vec3(p.tangents[v]), p.normals[v]), 0, 1e-6f);
    }
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1);
    EXPECT_TRUE(scene.notes.empty());
}

TEST(GltfGeometry, PointsLinesAndEmptyPrimitivesAreLeftOut) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["mode"] = mode;
        const Scene scene = f.load();
        EXPECT_TRUE(scene.meshes[0].primitives.empty());
    }
    GltfFile f = GltfFile::triangle();
    f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 1}, UBYTE, "SCALAR", 1);
    const Scene scene = f.load();
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    const Pose pose = poseAt(scene, 0);
    EXPECT_TRUE(pose.instances.empty());
    EXPECT_TRUE(worldBounds(scene, pose).empty());
    EXPECT_EQ(worldBounds(scene, pose).radius(), 0);
}

// Colours in every type and width that glTF allows: (1, 0.2, 0), with alpha 0.6 if there are four
// components.
TEST(GltfGeometry, VertexColorsOfEveryType) {
    for (const bool alpha : {false, true})
        for (const int type : {FLOAT, UBYTE, USHORT}) {
            GltfFile f = GltfFile::triangle();
            const char* shape = alpha ? "VEC4" : "VEC3";
            const std::size_t width = alpha ? 4 : 3;
            const auto values = [&]<class T>(T one) {
                std::vector<T> v;
                for (int i = 0; i < 3; ++i) {
                    const double row[] = {1, 0.2, 0, 0.6};
                    for (std::size_t c = 0; c < width; ++c)
                        v.push_back(static_cast<T>(row[c] * static_cast<double>(one)));
                }
                return v;
            };
            f.primitive()["attributes"]["COLOR_0"] =
                type == FLOAT   ? f.accessor(values(1.0f), type, shape, width)
                : type == UBYTE ? f.accessor(values(std::uint8_t{255}), type, shape, width, true)
                                : f.accessor(values(std::uint16_t{65535}), type, shape, width, true);
            const Scene scene = f.load();
            for (const glm::vec4& color : f.only(scene).colors)
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(color[c], glm::vec4(1, 0.2, 0, alpha ? 0.6 : 1)[c], 1e-6f)
                        << type << shape << c;
        }
}

// KHR_mesh_quantization; -128 normalized is -1, not -1.008 (glTF 2.0, 3.11).
TEST(GltfGeometry, QuantizedAttributes) {
    GltfFile f = GltfFile::triangle();
    f.json["extensionsUsed"] = f.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    f.primitive()["attributes"]["POSITION"] =
        f.accessor<std::int16_t>({0, 0, 0, 7, 0, 0, 0, -300, 0}, SHORT, "VEC3", 3);
    f.primitive()["attributes"]["NORMAL"] =
        f.accessor<std::int8_t>({0, 0, -128, 0, 0, -127, 0, 127, 0}, BYTE, "VEC3", 3, true);
    f.primitive()["attributes"]["TEXCOORD_0"] =
        f.accessor<std::uint16_t>({0, 65535, 13107, 0, 0, 0}, USHORT, "VEC2", 2, true);
    f.primitive()["attributes"]["TEXCOORD_1"] = f.accessor<std::int8_t>({-2, 3, 0, 0, 0, 0}, BYTE, "VEC2", 2);
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    EXPECT_EQ(p.positions[1], glm::vec3(7, 0, 0));
    EXPECT_EQ(p.positions[2], glm::vec3(0, -300, 0));
    EXPECT_EQ(p.normals[0], glm::vec3(0, 0, -1));
    EXPECT_EQ(p.normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(p.texcoords[0][0], glm::vec2(0, 1));
    EXPECT_FLOAT_EQ(p.texcoords[0][1].x, 0.2f);
    EXPECT_EQ(p.texcoords[1][0], glm::vec2(-2, 3));
}

TEST(GltfGeometry, StridesAndOffsetsAreFollowed) {
    GltfFile f = GltfFile::triangle();
    f.data.clear();
    const std::vector<float> interleaved{9, 0, 0, 0, 8, 1,
                                         0, 0, 8, 0, 1, 0};  // four bytes, then x y z and four bytes
    f.data.append(reinterpret_cast<const char*>(interleaved.data()), 48);
    f.json["bufferViews"][0] = {{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 44}, {"byteStride", 16}};
    f.json["accessors"][0]["byteOffset"] = 0;
    Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    f.json["bufferViews"][0]["byteLength"] = 43;
    EXPECT_NE(f.error().find("accessor 0: 3 vertices of 12 bytes end at 44, past bufferView 0 (43 bytes)"),
              std::string::npos)
        << f.error();
}

TEST(GltfGeometry, SparseAccessorsReplaceElements) {
    for (const bool base : {true, false}) {
        GltfFile f = GltfFile::triangle();
        const int indices = f.accessor<std::uint8_t>({1, 2}, UBYTE, "SCALAR", 1),
                  values = f.accessor<float>({4, 0, 0, 0, 5, 0}, FLOAT, "VEC3", 3);
        f.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", UBYTE}}},
                                            {"values", {{"bufferView", values}}}};
        if (!base) f.json["accessors"][0].erase("bufferView");
        const Scene scene = f.load();
        EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}}));
        f.data[f.json["bufferViews"][static_cast<std::size_t>(indices)]["byteOffset"]] = 3;
        EXPECT_NE(f.error().find("accessor 0: sparse index 3 is past its 3 elements"), std::string::npos)
            << f.error();
    }
}

TEST(GltfGeometry, NormalsWithoutDirectionComeFromTheTriangles) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["NORMAL"] = f.accessor<float>({0, 0, 0, 0, 3, 0, 0, 0, 0}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(GltfGeometry, TangentsAreMadeForNormalTexturesOnly) {
    for (const bool normalTexture : {true, false}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["material"] = 0;
        f.primitive()["attributes"]["NORMAL"] =
            f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
        f.primitive()["attributes"]["TEXCOORD_1"] =
            f.accessor<float>({0, 0, 0, 1, 1, 0}, FLOAT, "VEC2", 2);  // u grows upwards, v to the right
        f.json["images"] = {{{"uri", twoPixels}}};
        f.json["textures"] = {{{"source", 0}}};
        f.json["materials"] = Json::array({Json::object()});
        if (normalTexture) f.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
        const Scene scene = f.load();
        for (const glm::vec4& t : f.only(scene).tangents) {
            EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6f);
            if (normalTexture) {
                EXPECT_EQ(t, glm::vec4(0, 1, 0, 1));
            }
        }
    }
}

TEST(GltfGeometry, TangentsOfTheFileAreUsedOnlyWithItsNormals) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["TANGENT"] =
        f.accessor<float>({0, 2, 0, -1, 0, 2, 0, -1, 0, 0, 0, 1}, FLOAT, "VEC4", 4);
    Scene scene = f.load();
    EXPECT_EQ(f.only(scene).tangents[0].w, 1) << "without normals they are ignored (glTF 2.0, 3.7.2.1)";
    f.primitive()["attributes"]["NORMAL"] = f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    scene = f.load();
    EXPECT_EQ(f.only(scene).tangents[0], glm::vec4(0, 1, 0, -1));
    EXPECT_NEAR(glm::length(glm::vec3(f.only(scene).tangents[2])), 1, 1e-6f)
        << "one without a direction is replaced";
}

// A textured surface without texture coordinates shows a single texel and looks untextured.
TEST(GltfGeometry, MissingTextureCoordinatesAreNoted) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC2", 2);
    f.json["images"] = {{{"uri", twoPixels}}};
    f.json["textures"] = {{{"source", 0}}};
    auto& texture = f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture = {{"index", 0}};
    EXPECT_EQ(f.load().notes, std::vector<std::string>());
    texture["texCoord"] = 1;
    EXPECT_EQ(f.load().notes,
              std::vector<std::string>{
                  "mesh 0, primitive 0: its material reads TEXCOORD_1, which it lacks: 0, 0 is used"});
}
