// SPDX-License-Identifier: MIT
// The loader's error messages, word by word: file, object, fault.
#include "tests/support/gltf_builder.h"

#include <sys/stat.h>

#include <functional>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// A change to a valid file, and the complete message after the file's name.
struct Fault {
    const char* line;
    std::function<void(GltfFile&)> change;
};

void expectLines(const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) {
        GltfFile f = GltfFile::triangle();
        ASSERT_EQ(f.error(), "");
        fault.change(f);
        EXPECT_EQ(f.error(), (testFolder() / "scene.gltf").string() + ": " + fault.line);
    }
}

std::string linesFor(const std::string& text) {
    const std::string file = (testFolder() / "scene.gltf").string() + ": ";
    const std::string error = loadBytes(text, "scene.gltf");
    return error.starts_with(file) ? error.substr(file.size()) : error;
}

Json deep(int levels) {
    Json value;
    for (int i = 0; i < levels; ++i) value = Json::array({value});
    return value;
}

}  // namespace

TEST(GltfErrors, Schema) {
    expectLines({
        {"accessor 0: count is \"3\", not a whole number", sets("/accessors/0/count", "3")},
        {"accessor 0: count is 2.5, not a whole number", sets("/accessors/0/count", 2.5)},
        {"accessor 0: byteOffset is -4, not at least 0", sets("/accessors/0/byteOffset", -4)},
        {"accessor 0: type is \"VEC5\", not one of SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4",
         sets("/accessors/0/type", "VEC5")},
        {"accessor 0: bufferView 7, but the file has 1", sets("/accessors/0/bufferView", 7)},
        {"bufferView 0: byteStride 2 is not from 4 to 252", sets("/bufferViews/0/byteStride", 2)},
        {"bufferView 0: has no buffer", erases("/bufferViews/0", "buffer")},
        {"node 0: rotation has 3 numbers, not 4", sets("/nodes/0/rotation", {0, 0, 1})},
        {"node 0: scale[1] is null, not a number", sets("/nodes/0/scale", {1, nullptr, 1})},
        {"node 0: translation[2] is 1e+40, not at most 3.4028234663852886e+38",
         sets("/nodes/0/translation", {0, 0, 1e40})},
        {"node 0: children names node -1, but the file has 1", sets("/nodes/0/children", {-1})},
        {"mesh 0, primitive 0: attributes: NORMAL is \"x\", not an index",
         sets("/meshes/0/primitives/0/attributes/NORMAL", "x")},
        {"material 0: normalTexture: index names texture 3, but the file has 0",
         [](GltfFile& f) {
             f.primitive()["material"] = 0;
             f.json["materials"] = {{{"normalTexture", {{"index", 3}}}}};
         }},
        {"material 0: doubleSided is 1, not true or false",
         [](GltfFile& f) {
             f.primitive()["material"] = 0;
             f.json["materials"] = {{{"doubleSided", 1}}};
         }},
        {"node 0: KHR_lights_punctual: light 0, but the file has 0",
         sets("/nodes/0/extensions/KHR_lights_punctual/light", 0)},
        {"accessor 0: componentType 9999 does not exist", sets("/accessors/0/componentType", 9999)},
        {"accessor 0: type is \"VEC2 VEC3\", not one of SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4",
         sets("/accessors/0/type", "VEC2 VEC3")},
        {"accessor 0: 4 sparse elements for 3 elements",
         sets("/accessors/0/sparse", {{"count", 4},
                                      {"indices", {{"bufferView", 0}, {"componentType", UBYTE}}},
                                      {"values", {{"bufferView", 0}}}})},
        {"bufferView 0: byteStride 14 is not a multiple of 4", sets("/bufferViews/0/byteStride", 14)},
        {"light 0: is spot but has no spot",
         [](GltfFile& f) {
             f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
             f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
         }},
        {"mesh 0, primitive 0: attributes: A?B is not an attribute name",
         [](GltfFile& f) { f.primitive()["attributes"]["A\nB"] = 0; }},
        {"meshes is an object, not an array", sets("/meshes", Json::object())},
        {"extensionsRequired: KHR_texture_basisu is not supported; export the scene without it",
         sets("/extensionsRequired", {"KHR_texture_basisu", "KHR_texture_transform"})},
    });
}

TEST(GltfErrors, BuffersAndImages) {
    const auto buffer = [](const char* uri) {
        return [uri](GltfFile& f) {
            f.written();
            f.json["buffers"][0]["uri"] = uri;
            f.data.clear();  // keeps the uri
        };
    };
    expectLines({
        {"buffer 0: gone.bin: no such file", buffer("gone.bin")},
        {"buffer 0: .: is a folder", buffer(".")},
        {"buffer 0: ../x.bin: leaves the scene's folder", buffer("%2e%2e/x.bin")},
        {"buffer 0: /etc/passwd: an absolute path leaves the scene's folder", buffer("/etc/passwd")},
        {"buffer 0: http://example.org/x.bin: only files in the scene's folder and data URIs are read",
         buffer("http://example.org/x.bin")},
        {"buffer 0: its data URI has no comma before the data",
         buffer("data:application/octet-stream;base64")},
        {"buffer 0: its data URI has a comma in quotes before the data; write it as %2C",
         buffer("data:text/plain;x=\"a,b\";base64,AAAA")},
        {"buffer 0: its data is not base64 at character 3", buffer("data:;base64,AAA*")},
        {"buffer 0: has 3 of the 36 bytes in its byteLength", buffer("data:;base64,AAAA")},
        {"buffer 0: has no uri, and the file has no binary chunk for it",
         [](GltfFile& f) {
             f.written();
             f.json["buffers"][0].erase("uri");
             f.data.clear();
         }},
    });
    GltfFile f = GltfFile::triangle();
    f.json["images"] = {{{"uri", "a%0Ab.png"}}};
    f.json["textures"] = {{{"source", 0}}};
    f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    f.primitive()["material"] = 0;
    EXPECT_EQ(f.error(), (testFolder() / "scene.gltf").string() + ": image 0: a?b.png: no such file")
        << "a name cannot break the line";
}

TEST(GltfErrors, Documents) {
    EXPECT_EQ(linesFor(""), "is empty");
    EXPECT_EQ(linesFor("[]"), "its JSON is not an object");
    EXPECT_EQ(linesFor("null"), "its JSON is not an object");
    EXPECT_EQ(
        linesFor("{\"asset\": 1"),
        "is not JSON: parse error at line 1, column 12: syntax error while parsing object - unexpected end "
        "of input; expected '}'");
    EXPECT_EQ(linesFor("{}"), "asset: has no version");
    EXPECT_EQ(linesFor("{\"asset\": {\"version\": \"1.0\"}}"), "asset: version 1.0, not 2.0");
    EXPECT_EQ(linesFor("{\"asset\": {\"version\": 2.0}}"),
              "asset: version is 2.0, not a string; write \"2.0\"");
    EXPECT_EQ(linesFor("{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0}"), "scene 0, but the file has 0");
    EXPECT_EQ(linesFor("glTF\x02"), "is cut short: 5 of 12 header bytes");
    EXPECT_EQ(linesFor("{\"asset\": {\"version\": \"2.0\", \"extras\": 1e999}}"),
              "is not JSON: number overflow parsing '1e999'");
}

// A recursive parser needs a stack frame per level: a million levels are refused before it sees them.
TEST(GltfErrors, NestingIsBoundedBeforeParsing) {
    GltfFile f = GltfFile::triangle();
    f.json["extras"] = deep(127);
    f.json["nodes"][0]["name"] = "[[[{{{\\\"[[[";  // brackets in strings are not nesting
    EXPECT_EQ(f.error(), "");
    f.json["extras"] = deep(128);
    EXPECT_EQ(f.error(), (testFolder() / "scene.gltf").string() + ": is nested deeper than 128 levels");
    EXPECT_EQ(linesFor("{\"extras\":" + std::string(1000000, '[')), "is nested deeper than 128 levels");
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    EXPECT_EQ(linesFor("{\"extras\":" + objects), "is nested deeper than 128 levels");
}

// Symbolic links are followed within the folder and refused if they lead out of it.
TEST(GltfErrors, LinksStayInTheFolder) {
    namespace fs = std::filesystem;
    const fs::path folder = testFolder() / "scene", outside = testFolder() / "outside";
    fs::remove_all(folder);
    fs::create_directories(folder / "data");
    fs::create_directories(outside);
    GltfFile f = GltfFile::triangle();
    for (const fs::path& file : {folder / "data" / "real.bin", outside / "real.bin"})
        std::ofstream(file, std::ios::binary) << f.data;
    fs::create_symlink("data/real.bin", folder / "inside.bin");
    fs::create_symlink(outside / "real.bin", folder / "file.bin");
    fs::create_symlink(outside, folder / "folder");
    fs::create_symlink("loop.bin", folder / "loop.bin");
    ASSERT_EQ(mkfifo((folder / "pipe.bin").c_str(), 0600), 0);
    const auto outcome = [&](const char* uri) -> std::string {
        f.json["buffers"] = {{{"byteLength", f.data.size()}, {"uri", uri}}};
        std::ofstream(folder / "scene.gltf") << f.json.dump();
        try {
            loadScene((folder / "scene.gltf").string());
            return "";
        } catch (const std::runtime_error& e) {
            return std::string(e.what()).substr((folder / "scene.gltf").string().size());
        }
    };
    EXPECT_EQ(outcome("inside.bin"), "");
    EXPECT_EQ(outcome("data/../data/real.bin"), "");
    EXPECT_EQ(outcome("file.bin"), ": buffer 0: file.bin: is a link that leaves the scene's folder");
    EXPECT_EQ(outcome("folder/real.bin"),
              ": buffer 0: folder/real.bin: is a link that leaves the scene's folder");
    EXPECT_EQ(outcome("loop.bin"), ": buffer 0: loop.bin: Too many levels of symbolic links");
    EXPECT_EQ(outcome("pipe.bin"), ": buffer 0: pipe.bin: is not a regular file")
        << "reading it would wait forever";
}

TEST(GltfErrors, ScenesThatAreNoFiles) {
    const std::filesystem::path file = testFolder() / "pipe.gltf";
    std::filesystem::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    const auto outcome = [](const std::string& name) { return faultOf([&] { loadScene(name); }); };
    EXPECT_EQ(outcome(file.string()), file.string() + ": is not a regular file");
    std::filesystem::create_directories(testFolder() / "folder.glb");
    EXPECT_EQ(outcome((testFolder() / "folder.glb").string()),
              (testFolder() / "folder.glb").string() + ": is a folder");
    EXPECT_EQ(outcome("gone.gltf"), "gone.gltf: no such file");
    EXPECT_NE(outcome("scene.obj"), "");
}
