// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression: streams from the library's own encoder, decoded by the loader.
#include "shared/scene/gltf/gltf.h"
#include "tests/support/draco_builder.h"
#include "tests/support/files.h"

#include <draco/compression/encode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <random>
#include <string_view>

using namespace diptych;
using Json = nlohmann::json;

namespace {

std::vector<std::array<float, 9>> cornersOf(const Primitive& p) {
    std::vector<std::array<float, 9>> result;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        // Triangles may begin at any corner; here at the smallest one.
        std::array<std::array<float, 3>, 3> t;
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec3 v = glm::round(p.positions[p.indices[i + c]]);
            t[c] = {v.x, v.y, v.z};
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        result.push_back({t[0][0], t[0][1], t[0][2], t[1][0], t[1][1], t[1][2], t[2][0], t[2][1], t[2][2]});
    }
    std::sort(result.begin(), result.end());
    return result;
}

// Checks the n x n squares: each triangle exactly once, with the attributes for its corners' positions.
void expectSurface(const Primitive& p, int n, float positionError, float texcoordError) {
    Primitive expected;
    for (const auto& t : trianglesOf(n))
        for (const glm::vec3& corner : t) {
            expected.indices.push_back(static_cast<std::uint32_t>(expected.positions.size()));
            expected.positions.push_back(corner);
        }
    EXPECT_EQ(cornersOf(p), cornersOf(expected));
    for (std::size_t v = 0; v < p.positions.size(); ++v) {
        const glm::vec3 at = glm::round(p.positions[v]);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(p.positions[v][c], at[c], positionError);
        for (int c = 0; c < 2; ++c) ASSERT_NEAR(p.texcoords[0][v][c], texcoordAt(at)[c], texcoordError);
        ASSERT_EQ(p.texcoords[1][v], glm::vec2(countsAt(at)));
        ASSERT_EQ(p.colors[v], glm::vec4(colorAt(at)) / 255.0f);
        ASSERT_NEAR(p.normals[v].z, 1, 1e-6f);  // normalised by the loader, whether octahedral or exact
    }
}

std::string dracoLine(GltfFile& f) {
    const std::string binary = f.binary();
    try {
        parseGltf({binary.begin(), binary.end()}, "file");
    } catch (const std::runtime_error& e) {
        return std::string(e.what()).substr(6);  // "file: "
    }
    return "";
}

// Loads damaged bytes, which must give a scene or a one-line error. Returns that line.
std::string lineOfDamage(const std::string& binary) {
    try {
        parseGltf({binary.begin(), binary.end()}, "damaged");
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        return e.what();
    }
    return "";
}

}  // namespace

TEST(GltfDraco, EveryMethodAndSpeedGivesTheSurface) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
        for (const int speed : {0, 3, 7, 10})
            for (const int n : {1, 12}) {
                SCOPED_TRACE(testing::Message() << "method " << method << ", speed " << speed);
                GltfFile f = compressed(encoded(n, {method, speed}));
                const Scene scene = f.load();
                expectSurface(f.only(scene), n, 0, 0);
            }
}

// A coordinate quantized to 12 bits is off by at most half a step of the longest side: 12 and 3.
TEST(GltfDraco, QuantizedAttributesAreWithinHalfAStep) {
    for (const int speed : {0, 5}) {
        GltfFile f = compressed(encoded(12, {draco::MESH_EDGEBREAKER_ENCODING, speed, 12}));
        const Scene scene = f.load();
        expectSurface(f.only(scene), 12, 0.51f * 12 / 4095, 0.51f * 3 / 4095);
    }
}

TEST(GltfDraco, MetadataIsPassedOver) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        GltfFile f = compressed(encoded(3, {method, 5, 0, true}));
        EXPECT_NE(f.data.find("surface"), f.data.npos);
        const Scene scene = f.load();
        expectSurface(f.only(scene), 3, 0, 0);
    }
}

// The stream and the accessors' own data are different squares: each primitive gets its own.
TEST(GltfDraco, SharedAccessorsStayAsTheyAre) {
    GltfFile f = GltfFile::triangle();
    const DracoStream s = encoded(1, {draco::MESH_SEQUENTIAL_ENCODING});
    const int positions = f.accessor<float>({9, 0, 0, 10, 0, 0, 9, 1, 0, 10, 1, 0}, FLOAT, "VEC3", 3);
    const int indices = f.accessor<std::uint16_t>({0, 1, 2, 2, 1, 3}, USHORT, "SCALAR", 1);
    ASSERT_EQ(s.vertices, 4u);
    const Json plain = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
    f.json["meshes"][0]["primitives"] = {plain, plain};
    extensionOf(f) = {{"bufferView", viewOf(f, s.bytes)}, {"attributes", {{"POSITION", 0}}}};
    const Scene scene = f.load();
    const auto& primitives = scene.meshes.at(0).primitives;
    for (const glm::vec3& p : primitives.at(0).positions) EXPECT_LE(p.x, 1);
    for (const glm::vec3& p : primitives.at(1).positions) EXPECT_GE(p.x, 9);
}

TEST(GltfDraco, AttributesBesideTheStreamStay) {
    const DracoStream s = encoded(1);
    GltfFile f = compressed(s);
    extensionOf(f)["attributes"].erase("TEXCOORD_1");
    std::vector<float> other(2 * s.vertices, 0.25f);
    f.primitive()["attributes"]["TEXCOORD_1"] = f.accessor(other, FLOAT, "VEC2", 2);
    const Scene scene = f.load();
    for (const glm::vec2& t : f.only(scene).texcoords[1]) EXPECT_EQ(t, glm::vec2(0.25f));
}

// The stream of a strip contains separate triangles.
TEST(GltfDraco, StripsAreTriangles) {
    GltfFile f = compressed(encoded(2));
    f.primitive()["mode"] = 5;
    f.json["accessors"][5]["count"] = 14;
    const Scene scene = f.load();
    expectSurface(f.only(scene), 2, 0, 0);
}

TEST(GltfDraco, AMeshWhoseStreamIsBrokenIsLeftOutBesideOthers) {
    GltfFile f = compressed(encoded(2));
    extensionOf(f)["attributes"]["POSITION"] = 77;
    const int positions = f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
    f.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
    f.json["nodes"].push_back({{"mesh", 1}});
    f.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = f.load();
    EXPECT_TRUE(scene.meshes.at(0).primitives.empty());
    EXPECT_EQ(scene.meshes.at(1).primitives.size(), 1u);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_TRUE(scene.notes[0].starts_with("mesh 0, primitive 0: KHR_draco_mesh_compression: "))
        << scene.notes[0];
    EXPECT_TRUE(scene.notes[0].ends_with(": the mesh is left out")) << scene.notes[0];
}

TEST(GltfDraco, WhatIsWrongIsSaidInOneLine) {
    const DracoStream s = encoded(2);
    draco::PointCloud cloud;
    draco::EncoderBuffer points;
    cloud.set_num_points(1);
    draco::GeometryAttribute position;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
    const int id = cloud.AddAttribute(position, true, 1);
    const float origin[3] = {};
    cloud.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(0), origin);
    ASSERT_TRUE(draco::Encoder().EncodePointCloudToBuffer(cloud, &points).ok());

    struct Fault {
        const char* line;  // the text after "mesh 0, primitive 0: KHR_draco_mesh_compression: "
        std::function<void(GltfFile&)> change;
    };
    const auto count = [](std::size_t accessor, int value) {
        return [=](GltfFile& f) { f.json["accessors"][accessor]["count"] = value; };
    };
    const auto type = [](std::size_t accessor, const char* key, Json value) {
        return [=](GltfFile& f) { f.json["accessors"][accessor][key] = value; };
    };
    const auto byte = [](std::size_t at, char value) { return [=](GltfFile& f) { f.data[at] = value; }; };
    const Fault faults[] = {
        {"mode 0 is not triangles or a triangle strip", sets("/meshes/0/primitives/0/mode", 0)},
        {"NORMAL_9: the primitive has no such attribute",
         [](GltfFile& f) { extensionOf(f)["attributes"]["NORMAL_9"] = 3; }},
        {"NORMAL: 9 vertices, but COLOR_0 has 8", count(3, 8)},
        {"accessor 5: 23 indices are not a multiple of 3", count(5, 23)},
        {"its stream holds 8 triangles, not 9", count(5, 27)},
        {"its stream holds 9 vertices, not 10",
         [](GltfFile& f) {
             for (std::size_t a = 0; a < 5; ++a) f.json["accessors"][a]["count"] = 10;
         }},
        {"NORMAL: its stream has no attribute 7",
         [](GltfFile& f) { extensionOf(f)["attributes"]["NORMAL"] = 7; }},
        {"TEXCOORD_0: its stream has 2 components, but accessor 2 has 3", type(2, "type", "VEC3")},
        {"TEXCOORD_0: its stream has floats, but accessor 2 has unsigned shorts",
         type(2, "componentType", USHORT)},
        {"COLOR_0: its stream has unsigned bytes, but accessor 3 has normalized unsigned shorts",
         type(3, "componentType", USHORT)},
        {"is not a Draco stream", byte(0, 'd')},
        {"its stream has bitstream version 1.2, not 2.2", byte(5, 1)},
        {"its stream has the unknown encoding method 9", byte(8, 9)},
        {"its stream is a point cloud, not triangles",
         [&](GltfFile& f) {
             extensionOf(f)["bufferView"] = viewOf(f, {points.data(), points.size()});
         }},
        {"its stream is cut short", sets("/bufferViews/0/byteLength", 12)},
        {"its stream is damaged: Failed to decode point attributes",
         [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = f.data.size() - 9; }},
    };
    for (const Fault& fault : faults) {
        GltfFile f = compressed(s);
        ASSERT_EQ(dracoLine(f), "");
        fault.change(f);
        EXPECT_EQ(dracoLine(f),
                  std::string("mesh 0, primitive 0: KHR_draco_mesh_compression: ") + fault.line);
    }
}

// A few bytes may claim any number of vertices, which must not be trusted.
TEST(GltfDraco, ClaimsBeyondTheFileAreRefused) {
    GltfFile f = compressed(encoded(2));
    f.json["accessors"][5]["count"] = 30000000;
    EXPECT_EQ(dracoLine(f).find("its compressed geometry claims 960000"), 0u);
    GltfFile strip = compressed(encoded(2));
    strip.primitive().erase("indices");  // the indices alone give the number of triangles
    EXPECT_EQ(dracoLine(strip), "");
    strip.data.replace(13, 1, "\xff\xff\xff\x7f");
    strip.json["bufferViews"][0]["byteLength"] = strip.data.size();
    EXPECT_NE(dracoLine(strip).find("its stream claims 268435455 triangles"), std::string::npos)
        << dracoLine(strip);
}

// Predicted texture coordinates have one bit each. The library loops over the stream's number of bits, up
// to 2^31. A large number must be detected before, wherever it is in the stream.
TEST(GltfDraco, MoreOrientationsThanTexcoordsAreRefused) {
    const DracoStream s = encoded(4, {draco::MESH_EDGEBREAKER_ENCODING, 0, 10});
    GltfFile f = compressed(s);
    ASSERT_EQ(dracoLine(f), "");
    const std::string binary = f.binary();
    int seen = 0;
    for (std::size_t at = binary.size() - f.data.size(); at + 4 <= binary.size(); ++at) {
        std::string other = binary;
        other.replace(at, 4, "\xff\xff\xff\x7f");
        const std::string line = lineOfDamage(other);
        seen += line.find("its stream has 2147483647 orientations for 25 texture coordinates") != line.npos;
    }
    EXPECT_EQ(seen, 1);
}

// Damaged streams give a scene or a one-line error; AddressSanitizer checks memory.
TEST(GltfDraco, DamagedStreamsAreSceneOrLine) {
    std::mt19937 random(11);
    int scenes = 0, lines = 0;
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
        for (const int bits : {0, 8}) {
            GltfFile f = compressed(encoded(4, {method, 3, bits, bits != 0}));
            const std::string binary = f.binary();
            const std::size_t begin = binary.size() - f.data.size();
            for (int i = 0; i < 150; ++i) {
                std::string other = binary;
                for (auto flips = 1 + random() % 3; flips > 0; --flips) {
                    char& byte = other[begin + random() % f.data.size()];
                    byte = static_cast<char>(byte ^ (1 << random() % 8));
                }
                ++(lineOfDamage(other).empty() ? scenes : lines);
            }
            for (std::size_t length = 1; length < f.data.size(); length += 3) {  // truncated
                f.json["bufferViews"][0]["byteLength"] = length;
                dracoLine(f);
            }
        }
    EXPECT_GT(scenes, 0);
    EXPECT_GT(lines, 0);
}

// Draco's library contains another tinygltf with other structs, which must not be called instead.
TEST(GltfDraco, TinygltfIsItsOwnLibrary) {
    const std::string program = contentsOf(DIPTYCH_PROGRAM);
    const auto holds = [&](std::string_view text) {
        return ::memmem(program.data(), program.size(), text.data(), text.size()) != nullptr;
    };
    EXPECT_TRUE(holds("libtinygltf.so"));
    EXPECT_FALSE(holds("object not found in .gltf"));  // text in the code of Draco's tinygltf
}
