// SPDX-License-Identifier: MIT
#include "shared/scene/requirements.h"
#include "shared/scene/scene.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

namespace {

std::filesystem::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const auto result =
        std::filesystem::path(testing::TempDir()) / (std::string("diptych_gltf_") + test->name());
    std::filesystem::create_directories(result);
    return result;
}

constexpr int BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126;

// A file in the making: buffer 0 grows, and every accessor has a bufferView of its own.
struct File {
    Json json = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"scene", 0}};
    std::string data;

    template <class T>
    int accessor(const std::vector<T>& values, int componentType, const char* type, std::size_t width,
                 bool normalized = false) {
        while (data.size() % 4) data += '\0';
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", values.size() * sizeof(T)}});
        data.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"count", values.size() / width},
                                     {"type", type},
                                     {"normalized", normalized}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    // One triangle in the plane z = 0, facing +Z, in mesh 0 of node 0.
    static File triangle() {
        File f;
        const int positions = f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
        f.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        f.json["nodes"] = {{{"mesh", 0}}};
        return f;
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    std::string written(const std::string& name = "scene.gltf") {
        if (!data.empty()) {
            json["buffers"] = {{{"byteLength", data.size()}, {"uri", "a%20buffer.bin"}}};
            std::ofstream(folder() / "a buffer.bin", std::ios::binary) << data;
        }
        std::ofstream(folder() / name) << json.dump();
        return (folder() / name).string();
    }

    std::string binary() {
        json["buffers"] = {{{"byteLength", data.size()}}};
        std::string text = json.dump(), bytes = data;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        const auto word = [](std::size_t v) {
            const auto w = static_cast<std::uint32_t>(v);
            return std::string{static_cast<char>(w), static_cast<char>(w >> 8), static_cast<char>(w >> 16),
                               static_cast<char>(w >> 24)};
        };
        return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + bytes.size()) + word(text.size()) + "JSON" +
               text + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }

    Scene load() { return loadScene(written()); }
    const Primitive& only(const Scene& scene) const { return scene.meshes.at(0).primitives.at(0); }
    std::string error() {
        try {
            load();
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return "";
    }
};

std::string loadBytes(const std::string& bytes, const char* name = "scene.glb") {
    std::ofstream(folder() / name, std::ios::binary) << bytes;
    try {
        loadScene((folder() / name).string());
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
    for (const std::string& note : notes)
        if (note.find(text) != note.npos) return true;
    return false;
}

// A 2 x 1 PNG, red and half-transparent green; 8 bits, no filter.
const char* const twoPixels =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAA"
    "D0lEQVR4nGP4z8DwHwgbABB5A359Y87XAAAAAElFTkSuQmCC";

}  // namespace

// ---- geometry ----------------------------------------------------------------------------------------

TEST(Gltf, TriangleWithoutNormalsIsFlatWithATangentAndADefaultMaterial) {
    File f = File::triangle();
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

TEST(Gltf, BinaryHoldsTheSame) {
    File f = File::triangle();
    std::ofstream(folder() / "scene.GLB", std::ios::binary) << f.binary();
    const Scene scene = loadScene((folder() / "scene.GLB").string());
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Gltf, EveryIndexType) {
    for (const int type : {UBYTE, USHORT, UINT}) {
        File f = File::triangle();
        f.primitive()["indices"] = type == UBYTE    ? f.accessor<std::uint8_t>({2, 0, 1}, type, "SCALAR", 1)
                                   : type == USHORT ? f.accessor<std::uint16_t>({2, 0, 1}, type, "SCALAR", 1)
                                                    : f.accessor<std::uint32_t>({2, 0, 1}, type, "SCALAR", 1);
        const Scene scene = f.load();
        const Primitive& p = f.only(scene);
        EXPECT_EQ(p.positions[p.indices[0]], glm::vec3(0, 1, 0)) << type;
        EXPECT_EQ(p.positions[p.indices[2]], glm::vec3(1, 0, 0)) << type;
    }
}

// glTF 2.0, 3.7.2.1: a strip turns every other triangle, a fan turns around vertex 0; all keep facing +Z.
TEST(Gltf, StripsAndFansBecomeTriangles) {
    for (const int mode : {5, 6}) {
        File f = File::triangle();
        const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
            fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        f.primitive()["attributes"]["POSITION"] =
            f.accessor<float>(mode == 5 ? strip : fan, FLOAT, "VEC3", 3);
        f.primitive()["mode"] = mode;
        const Scene scene = f.load();
        const Primitive& p = f.only(scene);
        ASSERT_EQ(p.indices.size(), 6u);
        for (const glm::vec3& n : p.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1)) << mode;
    }
}

TEST(Gltf, PointsLinesAndEmptyPrimitivesAreLeftOutWithANote) {
    for (const int mode : {0, 1, 2, 3}) {
        File f = File::triangle();
        f.primitive()["mode"] = mode;
        const Scene scene = f.load();
        EXPECT_TRUE(scene.meshes[0].primitives.empty());
        EXPECT_TRUE(mentions(scene.notes, "mesh 0, primitive 0: points or lines"));
    }
    File f = File::triangle();
    f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 1}, UBYTE, "SCALAR", 1);
    const Scene scene = f.load();
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    EXPECT_TRUE(mentions(scene.notes, "no triangle"));
    const Pose pose = poseAt(scene, 0);
    EXPECT_TRUE(pose.instances.empty());
    EXPECT_TRUE(worldBounds(scene, pose).empty());
    EXPECT_EQ(worldBounds(scene, pose).radius(), 0);
}

// Colours as every type and width that glTF allows: (1, 0.2, 0) and, where there is one, alpha 0.6.
TEST(Gltf, VertexColorsOfEveryType) {
    for (const bool alpha : {false, true})
        for (const int type : {FLOAT, UBYTE, USHORT}) {
            File f = File::triangle();
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
TEST(Gltf, QuantizedAttributes) {
    File f = File::triangle();
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

TEST(Gltf, StridesAndOffsetsAreFollowed) {
    File f = File::triangle();
    f.data.clear();
    const std::vector<float> interleaved{9, 0, 0, 0, 8, 1,
                                         0, 0, 8, 0, 1, 0};  // a word, then x y z and a word
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

TEST(Gltf, SparseAccessorsReplaceElements) {
    for (const bool base : {true, false}) {
        File f = File::triangle();
        const int indices = f.accessor<std::uint8_t>({2, 1}, UBYTE, "SCALAR", 1),
                  values = f.accessor<float>({0, 5, 0, 4, 0, 0}, FLOAT, "VEC3", 3);
        f.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", UBYTE}}},
                                            {"values", {{"bufferView", values}}}};
        if (!base) f.json["accessors"][0].erase("bufferView");
        const Scene scene = f.load();
        EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}}));
        f.data[f.json["bufferViews"][static_cast<std::size_t>(indices)]["byteOffset"]] = 3;
        EXPECT_NE(f.error().find("accessor 0: sparse index 3 of 3"), std::string::npos) << f.error();
    }
}

TEST(Gltf, NormalsWithoutDirectionComeFromTheTriangles) {
    File f = File::triangle();
    f.primitive()["attributes"]["NORMAL"] = f.accessor<float>({0, 0, 0, 0, 3, 0, 0, 0, 0}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_TRUE(mentions(scene.notes, "2 normals have no direction"));
}

// ---- hostile numbers ---------------------------------------------------------------------------------

// Each change makes one number of a valid file wrong; the error names file, object and fault on one line.
TEST(Gltf, WrongNumbersAreRefusedByName) {
    struct Case {
        const char* expected;
        std::function<void(File&)> change;
    };
    const Case cases[] = {
        {"accessor 0: 4 vertices of 12 bytes end at 48, past bufferView 0 (36 bytes)",
         [](File& f) { f.json["accessors"][0]["count"] = 4; }},
        {"accessor 0: 9223372036854775807 vertices",
         [](File& f) { f.json["accessors"][0]["count"] = 9223372036854775807; }},
        {"accessor 0: 6148914691236517206 vertices",
         [](File& f) { f.json["accessors"][0]["count"] = 6148914691236517206; }},  // x 12 wraps
        {"accessor 0: 3 vertices", [](File& f) { f.json["accessors"][0]["byteOffset"] = 4; }},
        {"accessor 0: 3 vertices",
         [](File& f) { f.json["accessors"][0]["byteOffset"] = 18446744073709551600u; }},
        {"bufferView 0", [](File& f) { f.json["bufferViews"][0]["byteLength"] = 37; }},
        {"bufferView 0", [](File& f) { f.json["bufferViews"][0]["byteOffset"] = 18446744073709551600u; }},
        {"bufferView 0: buffer 1", [](File& f) { f.json["bufferViews"][0]["buffer"] = 1; }},
        {"stride of 8", [](File& f) { f.json["bufferViews"][0]["byteStride"] = 8; }},
        {"accessor 7", [](File& f) { f.primitive()["attributes"]["POSITION"] = 7; }},
        {"POSITION: accessor 0 is not VEC3", [](File& f) { f.json["accessors"][0]["type"] = "VEC4"; }},
        {"mesh 3", [](File& f) { f.json["nodes"][0]["mesh"] = 3; }},
        {"material 2", [](File& f) { f.primitive()["material"] = 2; }},
        {"NORMAL: 2 elements for 3 positions",
         [](File& f) {
             f.primitive()["attributes"]["NORMAL"] = f.accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
         }},
        {"index 1 of its indices is 3, past its 3 vertices",
         [](File& f) {
             f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 3, 2}, UBYTE, "SCALAR", 1);
         }},
        {"is not SCALAR",
         [](File& f) {
             f.primitive()["indices"] = f.accessor<float>({0, 1, 2}, FLOAT, "SCALAR", 1);
         }},
        {"POSITION: vertex 2 is not finite", [](File& f) { f.data.replace(24, 4, "\xff\xff\xff\xff"); }},
        {"is no mode", [](File& f) { f.primitive()["mode"] = 9; }},
        {"at most",
         [](File& f) {
             f.json["accessors"][0].erase("bufferView");
             f.json["accessors"][0]["count"] = 4000000000u;
         }},
        {"node 0: is its own ancestor",
         [](File& f) {
             f.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
         }},
        {"node 0: is its own ancestor",
         [](File& f) {
             f.json["nodes"] = {{{"children", {0}}}};
         }},
        {"node 2: is a child of node 0 and of node 1",
         [](File& f) {
             f.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
         }},
        {"node 0: child 5", [](File& f) { f.json["nodes"][0]["children"] = {5}; }},
        {"scene 0: node 4", [](File& f) { f.json["scenes"][0]["nodes"] = {4}; }},
        {"scene 3", [](File& f) { f.json["scene"] = 3; }},
        {"node 0: matrix has 15 numbers",
         [](File& f) { f.json["nodes"][0]["matrix"] = std::vector<double>(15, 0.0); }},
        {"node 0: camera 0", [](File& f) { f.json["nodes"][0]["camera"] = 0; }},
        {"extensionsRequired: KHR_draco_mesh_compression, EXT_odd is not built",
         [](File& f) {
             f.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_transform",
                                             "EXT_odd"};
         }},
        {"asset: version 1.0", [](File& f) { f.json["asset"]["version"] = "1.0"; }},
        {"nests deeper",
         [](File& f) {
             Json deep;
             for (int i = 0; i < 200; ++i) deep = Json::array({deep});
             f.json["extras"] = deep;
         }},
    };
    for (const Case& c : cases) {
        File f = File::triangle();
        ASSERT_EQ(f.error(), "");
        c.change(f);
        const std::string error = f.error();
        EXPECT_TRUE(error.starts_with((folder() / "scene.gltf").string() + ": "))
            << c.expected << " -> " << error;
        EXPECT_NE(error.find(c.expected), error.npos) << c.expected << " -> " << error;
        EXPECT_EQ(error.find('\n'), error.npos);
    }
}

TEST(Gltf, UrisStayInTheFolder) {
    std::ofstream(folder().parent_path() / "outside.bin", std::ios::binary) << std::string(36, '\0');
    for (const char* uri :
         {"../outside.bin", "%2e%2e/outside.bin", "a/../../outside.bin", "/etc/passwd", "file:///etc/passwd",
          "http://example.org/x.bin", "..\\outside.bin", "C:/x.bin", "a%00b"}) {
        File f = File::triangle();
        f.written();
        f.json["buffers"][0]["uri"] = uri;
        std::ofstream(folder() / "uri.gltf") << f.json.dump();
        try {
            loadScene((folder() / "uri.gltf").string());
            FAIL() << uri;
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find("buffer 0"), std::string::npos) << uri << ": " << e.what();
        }
    }
}

// Every prefix of a binary file, and every file with one wrong byte in its lengths, ends in an error or a
// scene.
TEST(Gltf, TruncatedBinariesAreRefused) {
    const std::string whole = File::triangle().binary();
    EXPECT_EQ(loadBytes(whole), "");
    for (std::size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 37)
        EXPECT_NE(loadBytes(whole.substr(0, size)), "") << size;
    for (std::size_t at = 4; at < 20; ++at)
        for (const char value : {'\x00', '\x01', '\x7f', '\xff'}) {
            std::string changed = whole;
            if (changed[at] == value) continue;
            changed[at] = value;
            EXPECT_NE(loadBytes(changed), "") << at;
        }
}

TEST(Gltf, MissingBuffersAreNamed) {
    File f = File::triangle();
    f.written();
    f.json["buffers"][0]["uri"] = "gone.bin";
    std::ofstream(folder() / "gone.gltf") << f.json.dump();
    try {
        loadScene((folder() / "gone.gltf").string());
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("buffer 0: gone.bin: no such file"), std::string::npos)
            << e.what();
    }
}

TEST(Gltf, OtherFilesAreRefusedInOneLine) {
    EXPECT_THROW(loadScene("scene.obj"), std::runtime_error);
    EXPECT_THROW(loadScene("no/such/scene.gltf"), std::runtime_error);
    for (const char* text :
         {"", "{", "[]", "{}", "null", "{\"asset\": {}}", "{\"asset\": {\"version\": 2}}"}) {
        const std::string error = loadBytes(text, "scene.gltf");
        EXPECT_NE(error, "") << text;
        EXPECT_EQ(error.find('\n'), error.npos);
    }
}

// ---- nodes, lights, cameras --------------------------------------------------------------------------

// A child before its parent in the list, TRS and matrix, and what no scene reaches is not drawn.
TEST(Gltf, NodesAreChainedInAnyOrder) {
    File f = File::triangle();
    const double s = std::sqrt(0.5);
    f.json["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 0, 0}}},
        {{"children", {0}}, {"rotation", {0, 0, s, s}}, {"scale", {2, 2, 2}}},  // 90 degrees around +Z
        {{"mesh", 0}},
        {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}}};
    f.json["scenes"] = {{{"nodes", {3}}}};
    const Scene scene = f.load();
    ASSERT_EQ(scene.nodes.size(), 3u);
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.instances.size(), 1u);
    const glm::dvec4 origin = pose.instances[0].world_from_object * glm::dvec4(0, 0, 0, 1);
    const glm::dvec4 x = pose.instances[0].world_from_object * glm::dvec4(1, 0, 0, 1);
    const double expected[2][3] = {{10, 22, 30}, {10, 24, 30}};
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(origin[c], expected[0][c], 1e-12);
        EXPECT_NEAR(x[c], expected[1][c], 1e-12);
    }
    EXPECT_NEAR(worldBounds(scene, pose).min.x, 8, 1e-12);
}

TEST(Gltf, DeepHierarchiesNeedNoStack) {
    File f = File::triangle();
    constexpr int depth = 20000;
    for (int i = 0; i < depth; ++i)
        f.json["nodes"][static_cast<std::size_t>(i)] = {{"children", {i + 1}}, {"translation", {1, 0, 0}}};
    f.json["nodes"][depth] = {{"mesh", 0}};
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0).instances.at(0).world_from_object[3].x, depth);
}

TEST(Gltf, SingularTransformsEndWell) {
    File f = File::triangle();
    f.json["nodes"][0]["scale"] = {0, 0, 0};
    const Scene scene = f.load();
    const Bounds bounds = worldBounds(scene, poseAt(scene, 0));
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.radius(), 0);
}

TEST(Gltf, LightsOfEveryKindDirectionalFirst) {
    File f = File::triangle();
    f.json["extensionsUsed"] = f.json["extensionsRequired"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}},
         {"range", 7},
         {"intensity", 30}},
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"name", "bulb"}},
        {{"type", "directional"}, {"intensity", 3}}};
    const auto lit = [](int light) { return Json{{"KHR_lights_punctual", {{"light", light}}}}; };
    const double s = std::sqrt(0.5);
    f.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}, {"scale", {2, 3, 4}}},
                       {{"extensions", lit(0)},
                        {"rotation", {-s, 0, 0, s}},
                        {"name", "lamp"}},  // -90 degrees around +X: -Z to -Y
                       {{"extensions", lit(1)}, {"translation", {1, 1, 1}}},
                       {{"extensions", lit(2)}}};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.lights.size(), 3u);
    const Light &sun = pose.lights[0], &spot = pose.lights[1], &point = pose.lights[2];
    EXPECT_EQ(sun.kind, LightKind::directional);
    EXPECT_EQ(sun.intensity, 3);
    EXPECT_EQ(sun.direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(spot.name, "lamp");
    EXPECT_NEAR(glm::length(spot.direction - glm::dvec3(0, -1, 0)), 0, 1e-12) << "scale does not count";
    EXPECT_EQ(spot.range, 7);
    EXPECT_EQ(spot.inner_cone, 0.25f);
    EXPECT_EQ(spot.outer_cone, 0.5f);
    EXPECT_EQ(point.name, "bulb");
    EXPECT_EQ(point.position, glm::dvec3(2, 3, 4));
    EXPECT_EQ(point.color, glm::vec3(1, 0.5, 0));
    EXPECT_TRUE(std::isinf(point.range));
}

TEST(Gltf, Cameras) {
    File f = File::triangle();
    f.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.5}}}, {"name", "wide"}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}}};
    f.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}},
                       {{"camera", 1}, {"name", "plan"}},
                       {{"camera", 0}, {"translation", {0, 0, 5}}}};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.cameras.size(), 2u);
    EXPECT_EQ(pose.cameras[0].name, "wide");
    EXPECT_EQ(pose.cameras[0].world_from_camera[3].z, 5);
    EXPECT_TRUE(std::isinf(pose.cameras[0].far));
    EXPECT_EQ(pose.cameras[1].name, "plan");
    EXPECT_TRUE(pose.cameras[1].orthographic);
    EXPECT_EQ(pose.cameras[1].ymag, 3);
    EXPECT_EQ(pose.cameras[1].far, 9);
    f.json["cameras"][0]["perspective"]["yfov"] = 4;
    EXPECT_NE(f.error().find("camera 0: yfov"), std::string::npos);
}

// ---- materials ---------------------------------------------------------------------------------------

TEST(Gltf, MaterialsTexturesSamplersAndTransforms) {
    File f = File::triangle();
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

TEST(Gltf, WhatIsDrawnOtherwiseIsNoted) {
    File f = File::triangle();
    f.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_clearcoat"};
    f.json["materials"] = {{{"name", "glass"}, {"alphaMode", "BLEND"}},
                           {{"name", "sign"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    const Scene scene = f.load();
    EXPECT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(f.only(scene).material, 2) << "the default material comes last";
    EXPECT_TRUE(mentions(scene.notes, "(glass) with alphaMode BLEND: drawn opaque"));
    EXPECT_TRUE(mentions(scene.notes, "(sign) with KHR_materials_unlit: drawn lit"));
    EXPECT_TRUE(mentions(scene.notes, "KHR_materials_clearcoat"));
}

TEST(Gltf, BrokenImagesInUseAreRefused) {
    for (const auto& [uri, expected] :
         {std::pair{"missing.png", "image 0 (missing.png): cannot be read"},
          std::pair{"scene.gltf", "image 0 (scene.gltf): is neither PNG nor JPEG"},
          std::pair{"data:image/png;base64,iVBORw0KGgoAAAAN", "image 0: does not decode"}}) {
        File f = File::triangle();
        f.json["images"] = {{{"uri", uri}}};
        f.json["textures"] = {{{"source", 0}}};
        f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
        EXPECT_NE(f.error().find(expected), std::string::npos) << f.error();
        f.json["materials"][0]["emissiveTexture"]["index"] = 1;
        EXPECT_NE(f.error().find("material 0: emissiveTexture: texture 1"), std::string::npos) << f.error();
    }
}

TEST(Gltf, ImagesInBufferViewsAreChecked) {
    File f = File::triangle();
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

TEST(Gltf, TangentsAreMadeForNormalTexturesOnly) {
    for (const bool normalTexture : {true, false}) {
        File f = File::triangle();
        f.primitive()["material"] = 0;
        f.primitive()["attributes"]["NORMAL"] =
            f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
        f.primitive()["attributes"]["TEXCOORD_1"] =
            f.accessor<float>({0, 0, 0, 1, 1, 0}, FLOAT, "VEC2", 2);  // u upwards, v rightwards
        f.json["images"] = {{{"uri", twoPixels}}};
        f.json["textures"] = {{{"source", 0}}};
        f.json["materials"] = {Json::object()};
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

TEST(Gltf, TangentsOfTheFileAreUsedOnlyWithItsNormals) {
    File f = File::triangle();
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

// ---- real files --------------------------------------------------------------------------------------

namespace {
const std::filesystem::path assets = std::filesystem::path(DIPTYCH_SOURCE_DIR "/../shared") / "assets";
}

// Triangles, draws and extents as the assets' own table lists them.
TEST(GltfAssets, ScenesHaveTheirTabledSizes) {
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": real files are not tried";
    struct Row {
        const char* file;
        std::uint64_t triangles, draws;
        double x, y, z;
    };
    for (const Row& row : {Row{"sponza/Sponza.gltf", 262267, 103, 29.77, 12.45, 18.31},
                           Row{"flight_helmet/FlightHelmet.gltf", 94722, 6, 0.37, 0.72, 0.37},
                           Row{"pbr_spheres/PBR_Spheres.glb", 100320, 12, 0.81, 0.89, 0.06},
                           Row{"features/box/Box.glb", 12, 1, 1, 1, 1},
                           Row{"features/lights_punctual/Lights.glb", 12, 1, 2, 2, 2},
                           Row{"features/vertex_color_test/VertexColorTest.gltf", 36, 2, 2, 2, 0.07},
                           Row{"features/node_hierarchy/02_node_hierarchy.gltf", 60, 2, 6, 6, 2},
                           Row{"features/sparse_accessor/SimpleSparseAccessor.gltf", 12, 1, 6, 4, 0},
                           Row{"low_poly_terrain/terrain.glb", 3868, 68, 16.68, 10.14, 16.74},
                           Row{"dutch_ship/dutch_ship_medium_1k.gltf", 69162, 3, 24.07, 24.66, 6.81},
                           Row{"normal_tangent_test/NormalTangentTest.glb", 7774, 1, 2.22, 2.15, 0.09}}) {
        const Scene scene = loadScene((assets / "scenes" / row.file).string());
        const Pose pose = poseAt(scene, 0);
        const Requirements r = requirements(scene, pose);
        EXPECT_EQ(r.triangles, row.triangles) << row.file;
        EXPECT_EQ(r.draws, row.draws) << row.file;
        const Bounds bounds = worldBounds(scene, pose);
        const glm::dvec3 extent = bounds.max - bounds.min;
        const double expected[] = {row.x, row.y, row.z};
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(extent[c], expected[c], 0.0101) << row.file << ": the table has two decimals";
        for (const Mesh& mesh : scene.meshes)
            for (const Primitive& p : mesh.primitives) {
                ASSERT_EQ(p.normals.size(), p.positions.size());
                ASSERT_EQ(p.tangents.size(), p.positions.size());
            }
    }
}

TEST(GltfAssets, MalformedFilesEndInASceneOrOneLine) {
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": malformed files are not tried";
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets / "malformed")) {
        if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
        ++files;
        try {
            const Scene scene = loadScene(entry.path().string());
            worldBounds(scene, poseAt(scene, 0));
        } catch (const std::runtime_error& e) {
            EXPECT_TRUE(std::string(e.what()).starts_with(entry.path().string() + ": ")) << e.what();
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        }
    }
    EXPECT_GT(files, 50);
}
