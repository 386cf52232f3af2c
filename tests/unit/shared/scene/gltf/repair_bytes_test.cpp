// SPDX-License-Identifier: MIT
// Common deviations of buffers and their URIs: the scene is drawn, with a note.
#include "tests/unit/shared/scene/gltf/as_is.h"

#include <utility>

using namespace diptych;
using Json = nlohmann::json;

namespace {

using ByteNotes = std::vector<std::string>;

const std::vector<glm::vec3> threeCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace

TEST(GltfRepairBytes, Strides) {
    GltfFile f = GltfFile::triangle();
    f.json["bufferViews"][0]["byteStride"] = 0;
    const int indices = f.accessor<std::uint16_t>({2, 1, 0}, USHORT, "SCALAR", 1);
    f.primitive()["indices"] = indices;
    f.json["bufferViews"][1]["byteStride"] = 2;
    Scene scene = f.load();
    EXPECT_EQ(scene.notes, (ByteNotes{"bufferView 0: byteStride 0: read as packed",
                                      "bufferView 1: byteStride 2 of packed indices: ignored"}));
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}));
    f.json["bufferViews"][1]["byteStride"] = 4;
    EXPECT_TRUE(f.error().ends_with(": bufferView 1: byteStride 4, but indices must be packed, 2 bytes each"))
        << f.error();
    f.primitive().erase("indices");
    EXPECT_EQ(f.error(), "") << "nothing that is drawn reads it";
}

TEST(GltfRepairBytes, BytesBesideTheChunks) {
    GltfFile f = GltfFile::triangle();
    std::string bytes = f.binary();
    const std::string chunk = std::string("\x04\0\0\0BIN\0", 8) + "more";
    std::string two = bytes + chunk;
    const std::uint32_t length = static_cast<std::uint32_t>(two.size());
    for (int i = 0; i < 4; ++i) two[8 + static_cast<std::size_t>(i)] = static_cast<char>(length >> 8 * i);
    writeBeside("two.glb", two);
    writeBeside("after.glb", bytes + "garbage");
    Scene scene = loadScene((testFolder() / "two.glb").string());
    EXPECT_EQ(scene.notes, ByteNotes{"2 binary chunks: only the first is read"});
    EXPECT_EQ(f.only(scene).positions, threeCorners);
    scene = loadScene((testFolder() / "after.glb").string());
    EXPECT_EQ(scene.notes,
              ByteNotes{"7 bytes after the " + std::to_string(bytes.size()) + " in its header: ignored"});
    EXPECT_EQ(f.only(scene).positions, threeCorners);
}

// gltfpack -cf: the fallback buffer's file is only for other readers, and often missing.
TEST(GltfRepairBytes, FallbackBuffersMayBeMissing) {
    for (const bool uri : {true, false}) {
        GltfFile f = GltfFile::triangle();
        f.written();
        Json fallback = {{"byteLength", 36},
                         {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
        if (uri) fallback["uri"] = "scene.fallback.bin";
        f.json["buffers"].push_back(fallback);
        const Scene scene = loadAsIs(f);
        EXPECT_EQ(f.only(scene).positions, threeCorners);
        EXPECT_EQ(scene.notes,
                  uri ? ByteNotes{"buffer 1: scene.fallback.bin: no such file: the scene does not use it"}
                      : ByteNotes{});
    }
}

// Indices of 6 bytes, padded to 8 at the buffer's end: byteLength counts the padding, but the file lacks
// it.
TEST(GltfRepairBytes, PaddingThatIsNotThereIsNotNeeded) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["indices"] = f.accessor<std::uint16_t>({2, 1, 0}, USHORT, "SCALAR", 1);
    f.written();
    ASSERT_EQ(f.data.size(), 42u);
    const std::vector<glm::vec3> turned{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
    f.json["bufferViews"][1]["byteLength"] = 8;
    Scene scene = loadAsIs(f);
    EXPECT_EQ(scene.notes,
              ByteNotes{"bufferView 1: 8 bytes at offset 36 end past buffer 0 (42 bytes): the scene "
                        "does not use the rest"});
    EXPECT_EQ(f.only(scene).positions, turned);
    f.json["buffers"][0]["byteLength"] = 44;
    scene = loadAsIs(f);
    EXPECT_EQ(
        scene.notes,
        ByteNotes{"buffer 0: has 42 of the 44 bytes in its byteLength: the scene does not use the rest"});
    EXPECT_EQ(f.only(scene).positions, turned);
    // Bytes that are drawn must exist.
    writeBeside("a buffer.bin", f.data.substr(0, 41));
    EXPECT_EQ(errorAsIs(f), "buffer 0: has 41 of the 44 bytes in its byteLength");
    f.json["buffers"][0]["byteLength"] = 41;
    EXPECT_EQ(errorAsIs(f), "bufferView 1: 8 bytes at offset 36 end past buffer 0 (41 bytes)");
    // All bytes of a view are missing.
    f.json["bufferViews"][1]["byteOffset"] = 41;
    EXPECT_EQ(errorAsIs(f), "bufferView 1: 8 bytes at offset 41 end past buffer 0 (41 bytes)");
}

// An empty view of an empty buffer is valid.
TEST(GltfRepairBytes, EmptyBuffersAreNobodysFault) {
    GltfFile f = GltfFile::triangle();
    f.written();
    f.json["buffers"].push_back({{"byteLength", 0}, {"uri", "data:,"}});
    f.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 0}});
    EXPECT_EQ(loadAsIs(f).notes, ByteNotes{});
    f.json["accessors"][0]["bufferView"] = 1;
    EXPECT_EQ(errorAsIs(f), "accessor 0: 3 vertices of 12 bytes end at 36, past bufferView 1 (0 bytes)");
}

TEST(GltfRepairBytes, UrisOfEveryKindOfWriter) {
    GltfFile f = GltfFile::triangle();
    f.written();
    writeBeside("a%20b.bin", f.data);
    writeBeside("sub/x.bin", f.data);
    writeBeside("sub/y z.bin", f.data);
    writeBeside("both one.bin", f.data);
    writeBeside("both%20one.bin", std::string(36, 'x'));  // the decoded name is tried first
    // (0 0 0) (1 0 0) (0 1 0) as floats; 0x3f80 is "gD8" after two zero bytes
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    std::string bytes;
    for (int i = 0; i < 36; ++i) bytes += i == 14 || i == 30 ? "%80" : i == 15 || i == 31 ? "%3f" : "%00";
    std::string percent = base64;
    for (std::size_t at; (at = percent.find("g")) != percent.npos;) percent.replace(at, 1, "%67");
    const std::pair<std::string, std::string> cases[] = {
        {"both%20one.bin", ""},
        {"a%20b.bin", "buffer 0: a%20b.bin: its uri is read without percent-decoding"},
        {"sub\\x.bin", "buffer 0: sub/x.bin: a backslash in its uri is read as /"},
        {"sub%5Cx.bin", "buffer 0: sub/x.bin: a backslash in its uri is read as /"},
        {"sub\\y%20z.bin", "buffer 0: sub/y z.bin: a backslash in its uri is read as /"},
        {"data:," + bytes, ""},
        {"data:application/gltf-buffer;base64," + base64, ""},
        {"data:application/octet-stream;base64," + base64, ""},
        {"DATA:;base64," + base64, ""},
        {"Data:application/octet-stream;BASE64," + base64, ""},
        {"data:;base64," + percent, ""},
        {"data:;base64," + base64 + "==", ""},
        {"data:;base64," + base64 + "=\n", ""},
        {"data:;base64," + base64 + "==AAAA",
         "buffer 0: its base64 continues after its end, at character 50: ignored"},
    };
    for (const auto& [uri, note] : cases) {
        f.json["buffers"][0]["uri"] = uri;
        const Scene scene = loadAsIs(f);
        EXPECT_EQ(f.only(scene).positions, threeCorners) << uri;
        EXPECT_EQ(scene.notes, note.empty() ? ByteNotes{} : ByteNotes{note}) << uri;
    }
    // +, / and = percent-encoded: the bytes 0xfb 0xef 0xff are "++//", the byte 0xfb alone is "+w==".
    f.json["buffers"].push_back({{"byteLength", 4}, {"uri", "data:;base64,%2B%2b%2F%2f%2Bw%3D%3D"}});
    EXPECT_EQ(loadAsIs(f).notes.size(), 1u) << "only that of buffer 0";
    f.json["buffers"][1]["byteLength"] = 5;
    EXPECT_TRUE(mentions(loadAsIs(f).notes, "buffer 1: has 4 of the 5 bytes in its byteLength"));
}

// No spelling of a path leads out of the folder.
TEST(GltfRepairBytes, OddUrisStayInTheFolder) {
    GltfFile f = GltfFile::triangle();
    f.written();
    writeBeside("../outside.bin", f.data);
    for (const char* uri : {"..\\outside.bin", "sub\\..\\..\\outside.bin", "%2e%2e%5Coutside.bin",
                            "sub/..\\../outside.bin", "\\outside.bin", "%5Coutside.bin"}) {
        f.json["buffers"][0]["uri"] = uri;
        EXPECT_TRUE(errorAsIs(f).ends_with("leaves the scene's folder")) << uri << ": " << errorAsIs(f);
    }
}
