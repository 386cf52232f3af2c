// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/gltf.h"
#include "tests/support/gltf_builder.h"

#include <algorithm>
#include <functional>

using namespace diptych;
using Json = nlohmann::json;

TEST(GltfLoading, BinaryHoldsTheSame) {
    GltfFile f = GltfFile::triangle();
    std::ofstream(testFolder() / "scene.GLB", std::ios::binary) << f.binary();
    const Scene scene = loadScene((testFolder() / "scene.GLB").string());
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

// Each change breaks one number of a valid file; the error names file, object and fault on one line.
TEST(GltfLoading, WrongNumbersAreRefusedByName) {
    struct Case {
        const char* expected;
        std::function<void(GltfFile&)> change;
    };
    const Case cases[] = {
        {"accessor 0: 4 vertices of 12 bytes end at 48, past bufferView 0 (36 bytes)",
         sets("/accessors/0/count", 4)},
        {"accessor 0: count is 9223372036854775807, not at most 9007199254740992",
         sets("/accessors/0/count", 9223372036854775807)},
        {"accessor 0: count is 6148914691236517206, not at most",
         // Times 12 overflows 64 bits.
         sets("/accessors/0/count", 6148914691236517206)},
        {"accessor 0: 3 vertices", sets("/accessors/0/byteOffset", 4)},
        {"accessor 0: byteOffset is 18446744073709551600, not at most",
         sets("/accessors/0/byteOffset", 18446744073709551600u)},
        {"bufferView 0: 36 bytes at offset 4", sets("/bufferViews/0/byteOffset", 4)},
        {"bufferView 0", sets("/bufferViews/0/byteOffset", 18446744073709551600u)},
        {"bufferView 0: buffer 1", sets("/bufferViews/0/buffer", 1)},
        {"stride of 8", sets("/bufferViews/0/byteStride", 8)},
        {"POSITION: accessor 0 is not VEC3", sets("/accessors/0/type", "VEC4")},
        {"material 2", sets("/meshes/0/primitives/0/material", 2)},
        {"index 1 of its indices is 3, past its 3 vertices",
         [](GltfFile& f) {
             f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 3, 2}, UBYTE, "SCALAR", 1);
         }},
        {"is not SCALAR",
         [](GltfFile& f) {
             f.primitive()["indices"] = f.accessor<float>({0, 1, 2}, FLOAT, "SCALAR", 1);
         }},
        {"mesh 0, primitive 0: mode is 9, not from 0 to 6", sets("/meshes/0/primitives/0/mode", 9)},
        {"4000000000 vertices without a bufferView; the limit is 16777216",
         [](GltfFile& f) {
             f.json["accessors"][0].erase("bufferView");
             f.json["accessors"][0]["count"] = 4000000000u;
         }},
        {"node 0: is its own ancestor", sets("/nodes", {{{"children", {1}}}, {{"children", {0}}}})},
        {"node 0: is its own ancestor", sets("/nodes", {{{"children", {0}}}})},
        {"node 2: is a child of node 0 and of node 1",
         sets("/nodes", {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}})},
        {"scene 0: nodes names node 4, but the file has 1", sets("/scenes/0/nodes", {4})},
        {"node 0: matrix has 15 numbers", sets("/nodes/0/matrix", std::vector<double>(15, 0.0))},
        {"node 0: camera 0", sets("/nodes/0/camera", 0)},
        {"extensionsRequired: KHR_texture_basisu, EXT_odd is not supported",
         sets("/extensionsRequired", {"KHR_texture_basisu", "KHR_texture_transform", "EXT_odd"})},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        ASSERT_EQ(f.error(), "");
        c.change(f);
        const std::string error = f.error();
        EXPECT_TRUE(error.starts_with((testFolder() / "scene.gltf").string() + ": "))
            << c.expected << " -> " << error;
        EXPECT_NE(error.find(c.expected), error.npos) << c.expected << " -> " << error;
        EXPECT_EQ(error.find('\n'), error.npos);
    }
}

TEST(GltfLoading, UrisStayInTheFolder) {
    std::ofstream(testFolder().parent_path() / "outside.bin", std::ios::binary) << std::string(36, '\0');
    for (const char* uri :
         {"../outside.bin", "%2e%2e/outside.bin", "a/../../outside.bin", "/etc/passwd", "file:///etc/passwd",
          "http://example.org/x.bin", "..\\outside.bin", "C:/x.bin", "a%00b"}) {
        GltfFile f = GltfFile::triangle();
        f.written();
        f.json["buffers"][0]["uri"] = uri;
        std::ofstream(testFolder() / "uri.gltf") << f.json.dump();
        const std::string fault = faultOf([] { loadScene((testFolder() / "uri.gltf").string()); });
        EXPECT_NE(fault.find("buffer 0"), std::string::npos) << uri << ": " << fault;
    }
}

// Every prefix of a binary file, and every file with one wrong byte in its lengths, gives a scene or an
// error.
TEST(GltfLoading, TruncatedBinariesAreRefused) {
    const std::string whole = GltfFile::triangle().binary();
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

// In JSON Schema, 3.0 is an integer.
TEST(GltfLoading, WholeNumbersMayBeWrittenWithAPoint) {
    GltfFile f = GltfFile::triangle();
    f.json["accessors"][0]["count"] = 3.0;
    f.json["nodes"][0]["mesh"] = 0.0;
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions.size(), 3u);
}

TEST(GltfLoading, NamesHoldNoControlCharacters) {
    GltfFile f = GltfFile::triangle();
    f.json["nodes"][0]["name"] = "a\nb\x1b[2J\u00e4";
    f.json["meshes"][0]["name"] = std::string(1000, 'x');
    const Scene scene = f.load();
    EXPECT_EQ(scene.nodes[0].name, "a?b?[2J\u00e4");
    EXPECT_EQ(scene.meshes[0].name, std::string(200, 'x') + "...");
}

// The default scene, or the one chosen by index or name.
TEST(GltfLoading, OneOfSeveralScenes) {
    GltfFile f = GltfFile::triangle();
    f.json["nodes"] = {{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}, {{"name", "c"}}};
    f.json["scenes"] = {
        {{"nodes", {0}}}, {{"nodes", {1}}, {"name", "second"}}, {{"nodes", {2}}, {"name", "0"}}};
    f.json["scene"] = 1;
    const std::string file = f.written();
    const auto node = [](const std::string& where) { return loadScene(where).nodes.at(0).name; };
    EXPECT_EQ(node(file), "b");
    EXPECT_EQ(node(file + "?scene=0"), "a");
    EXPECT_EQ(node(file + "?scene=second"), "b");
    EXPECT_EQ(node(file + "?scene=2"), "c");
    EXPECT_EQ(faultOf([&] { node(file + "?scene=third"); }),
              file + ": scene=third: the file's scenes are 0, 1 \"second\", 2 \"0\"");
    f.json.erase("scene");
    EXPECT_EQ(f.load().nodes.at(0).name, "a") << "the first where none is the default";
    f.json.erase("scenes");
    EXPECT_EQ(f.load().nodes.size(), 3u) << "all where there is no scene";
}

// Only byteLength bytes of a buffer's file are read, however large the file is.
TEST(GltfLoading, OnlyWhatABufferNamesIsRead) {
    GltfFile f = GltfFile::triangle();
    f.written();
    // A sparse file with 3 GiB after the data: sixteen of them would not fit in memory.
    std::filesystem::resize_file(testFolder() / "a buffer.bin", std::uint64_t(3) << 30);
    const Json buffer = f.json["buffers"][0];
    for (int i = 1; i < 16; ++i) f.json["buffers"].push_back(buffer);
    f.data.clear();
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions.size(), 3u);
    std::filesystem::remove(testFolder() / "a buffer.bin");
}

// Two image files slightly larger than the limit together; the large one is a sparse file.
TEST(GltfLoading, ImageFilesHaveALimitTogether) {
    GltfFile f = GltfFile::triangle();
    f.written();
    for (const auto& [name, bytes] : {std::pair{"hole.png", std::uint64_t(2) << 30}, {"byte.png", 1}}) {
        std::ofstream(testFolder() / name).close();
        std::filesystem::resize_file(testFolder() / name, bytes);
        f.json["images"].push_back({{"uri", name}});
        f.json["textures"].push_back({{"source", f.json["textures"].size()}});
    }
    f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}, {"normalTexture", {{"index", 1}}}}};
    f.primitive()["material"] = 0;
    const std::string error = f.error();
    EXPECT_NE(error.find("the image files together exceed the limit of 2147483648 bytes"), std::string::npos)
        << error;
    std::filesystem::remove(testFolder() / "hole.png");
}

TEST(GltfLoading, ObjectsAndValuesHaveALimit) {
    // An array of `count` equal items.
    const auto faultOfMany = [](const std::string& key, std::size_t count, const std::string& item) {
        const std::string head = R"({"asset":{"version":"2.0"},")" + key + "\":[", tail = "]}";
        std::vector<unsigned char> text(head.size() + count * (item.size() + 1) - 1 + tail.size(), ',');
        std::ranges::copy(head, text.begin());
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < item.size(); ++c)
                text[head.size() + i * (item.size() + 1) + c] = static_cast<unsigned char>(item[c]);
        std::ranges::copy(tail, text.end() - static_cast<std::ptrdiff_t>(tail.size()));
        return faultOf([&] { parseGltf(std::move(text), "a"); });
    };
    EXPECT_NE(faultOfMany("nodes", 2097151, "{}").find("has 2097153 objects; the limit is 2097152"),
              std::string::npos);
    EXPECT_NE(faultOfMany("extras", 33554432, "0").find("has 33554436 values; the limit is 33554432"),
              std::string::npos);
}

TEST(GltfLoading, ErrorsHaveAnEnd) {
    GltfFile f = GltfFile::triangle();
    for (int i = 0; i < 1000; ++i) f.json["extensionsUsed"].push_back("EXT_" + std::to_string(i));
    f.json["extensionsRequired"] = f.json["extensionsUsed"];
    EXPECT_LT(f.error().size(), 500u);
    f.json["extensionsRequired"] = Json::array();
    f.json["images"] = {{{"bufferView", 0}, {"uri", "data:image/png;base64," + std::string(100000, 'A')}}};
    f.json["textures"] = {{{"source", 0}}};
    f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    f.primitive()["material"] = 0;
    const std::string error = f.error();
    EXPECT_NE(error.find("image 0"), error.npos) << error;
    EXPECT_LT(error.size(), 500u) << "a data URI is no name";
}
