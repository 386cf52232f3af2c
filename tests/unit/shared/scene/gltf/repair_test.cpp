// SPDX-License-Identifier: MIT
// Common deviations from the specification in real files: the scene is drawn, with a note.
#include "shared/scene/motion/pose.h"
#include "tests/unit/shared/scene/gltf/as_is.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

using namespace diptych;
using Json = nlohmann::json;

namespace {

using Lines = std::vector<std::string>;

const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace

// ---- undrawn parts -----------------------------------------------------------------------------------

TEST(GltfRepair, BrokenThingsThatNothingDrawsAreNoted) {
    struct Case {
        const char* note;
        std::function<void(GltfFile&)> change;
    };
    const Json bad = {{"index", 9}};
    const Case cases[] = {
        {"buffer 1: gone.bin: no such file: the scene does not use it",
         sets("/buffers/-", {{"byteLength", 4}, {"uri", "gone.bin"}})},
        {"buffer 1: has no uri, and the file has no binary chunk for it: the scene does not use it",
         sets("/buffers/-", {{"byteLength", 4}})},
        {"buffer 1: has no byteLength: left out", sets("/buffers/-", {{"uri", "gone.bin"}})},
        {"bufferView 1: buffer 5, but the file has 1: left out",
         sets("/bufferViews/-", {{"buffer", 5}, {"byteLength", 4}})},
        {"accessor 1: componentType 7 does not exist: left out",
         sets("/accessors/-", {{"componentType", 7}, {"count", 1}, {"type", "SCALAR"}})},
        {"sampler 0: wrapS is \"x\", not a whole number: left out", sets("/samplers", {{{"wrapS", "x"}}})},
        {"image 0: bufferView 7, but the file has 1: left out", sets("/images", {{{"bufferView", 7}}})},
        {"material 0: normalTexture: index names texture 9, but the file has 0: left out",
         [bad](GltfFile& f) {
             f.json["materials"] = {{{"normalTexture", bad}}};
         }},
        {"mesh 1, primitive 0: attributes: POSITION names accessor 9, but the file has 1: left out",
         sets("/meshes/-", {{"primitives", {{{"attributes", {{"POSITION", 9}}}}}}})},
        {"node 1: mesh 9, but the file has 1: left out", sets("/nodes/-", {{"mesh", 9}})},
        {"camera 0: is perspective but has no perspective: left out",
         [](GltfFile& f) {
             f.json["cameras"] = {{{"type", "perspective"}}};
             f.json["nodes"][0]["camera"] = 0;
         }},
        {"light 0: is spot but has no spot: left out",
         sets("/extensions/KHR_lights_punctual/lights", {{{"type", "spot"}}})},
        {"animation 0, sampler 0: input names accessor 9, but the file has 1: left out",
         sets("/animations",
              {{{"samplers", {{{"input", 9}, {"output", 0}}}},
                {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}})},
        {"animation 0, channel 0: target: has no path: left out",
         sets("/animations",
              {{{"samplers", Json::array()}, {"channels", {{{"sampler", 0}, {"target", Json::object()}}}}}})},
        {"skin 0: inverseBindMatrices names accessor 9, but the file has 1: left out",
         [](GltfFile& f) {
             f.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", 9}}};
             f.json["nodes"][0]["skin"] = 0;
         }},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        f.written();
        c.change(f);
        const Scene scene = loadAsIs(f);
        EXPECT_EQ(scene.notes, Lines{c.note});
        EXPECT_EQ(f.only(scene).positions, corners) << c.note;
        EXPECT_TRUE(scene.cameras.empty() && scene.animations.empty() && scene.skins.empty()) << c.note;
    }
}

// The same faults in parts that the scene needs.
TEST(GltfRepair, BrokenThingsThatAreDrawnAreRefused) {
    struct Case {
        const char* line;
        std::function<void(GltfFile&)> change;
    };
    const Case cases[] = {
        {"buffer 0: gone.bin: no such file", sets("/buffers/0/uri", "gone.bin")},
        {"buffer 0: has no byteLength", erases("/buffers/0", "byteLength")},
        {"bufferView 0: buffer 5, but the file has 1", sets("/bufferViews/0/buffer", 5)},
        {"sampler 0: wrapS is \"x\", not a whole number",
         [](GltfFile& f) {
             f.json["samplers"] = {{{"wrapS", "x"}}};
             f.json["images"] = {{{"uri", twoPixels}}};
             f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
             f.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
             f.primitive()["material"] = 0;
         }},
        {"light 0: is spot but has no spot",
         [](GltfFile& f) {
             f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
             f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
         }},
        // In a file without scenes all nodes are drawn.
        {"node 1: mesh 9, but the file has 1",
         [](GltfFile& f) {
             f.json["nodes"].push_back({{"mesh", 9}});
             f.json.erase("scenes");
             f.json.erase("scene");
         }},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        f.written();
        c.change(f);
        EXPECT_EQ(errorAsIs(f), c.line);
    }
}

// A faulty mesh or primitive is skipped if something else is drawn, otherwise the file is refused.
TEST(GltfRepair, AFaultyMeshIsLeftOutBesideOthers) {
    struct Case {
        const char* line;  // the fault, in mesh 1
        const char* note;
        std::function<void(GltfFile&, Json& mesh)> change;
    };
    const auto primitive = [](Json& mesh) -> Json& { return mesh["primitives"][0]; };
    const Case cases[] = {
        {"accessor 1: 300 vertices of 12 bytes end at 3600, past bufferView 1 (36 bytes)",
         "mesh 1, primitive 0: left out, it needs accessor 1: 300 vertices of 12 bytes end at 3600, past "
         "bufferView 1 (36 bytes)",
         [](GltfFile& f, Json&) { f.json["accessors"][1]["count"] = 300; }},
        {"accessor 1: componentType 7 does not exist",
         "mesh 1: left out, it needs accessor 1: componentType 7 does not exist",
         [](GltfFile& f, Json&) { f.json["accessors"][1]["componentType"] = 7; }},
        {"mesh 1, primitive 0: attributes: POSITION names accessor 99, but the file has 2",
         "mesh 1, primitive 0: attributes: POSITION names accessor 99, but the file has 2: left out",
         [&](GltfFile&, Json& mesh) { primitive(mesh)["attributes"]["POSITION"] = 99; }},
        {"mesh 1, primitive 0: index 1 of its indices is 9, past its 3 vertices",
         "mesh 1, primitive 0: index 1 of its indices is 9, past its 3 vertices: left out",
         [&](GltfFile& f, Json& mesh) {
             primitive(mesh)["indices"] = f.accessor<std::uint8_t>({0, 9, 2}, UBYTE, "SCALAR", 1);
         }},
        {"mesh 1, primitive 0: NORMAL: has 2 elements for 3 positions",
         "mesh 1, primitive 0: NORMAL: has 2 elements for 3 positions: left out",
         [&](GltfFile& f, Json& mesh) {
             primitive(mesh)["attributes"]["NORMAL"] =
                 f.accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
         }},
        {"mesh 1: 2 weights for 0 morph targets", "mesh 1: 2 weights for 0 morph targets: left out",
         [](GltfFile&, Json& mesh) {
             mesh["weights"] = {1, 0};
         }},
        {"buffer 1: gone.bin: no such file",
         "mesh 1, primitive 0: left out, it needs buffer 1: gone.bin: no such file",
         [](GltfFile& f, Json&) {
             f.json["buffers"].push_back({{"byteLength", 36}, {"uri", "gone.bin"}});
             f.json["bufferViews"][1] = {{"buffer", 1}, {"byteLength", 36}};
         }},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        const int positions = f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
        f.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
        f.json["nodes"].push_back({{"mesh", 1}, {"name", "faulty"}});
        f.json["scenes"][0]["nodes"] = {0, 1};
        f.written();
        Json mesh = f.json["meshes"][1];
        c.change(f, mesh);
        f.json["meshes"][1] = mesh;
        const std::string buffers = f.json["buffers"].dump();
        f.written();  // including the change's additions
        if (f.json["buffers"].size() != Json::parse(buffers).size())
            f.json["buffers"].push_back(Json::parse(buffers)[1]);
        const Scene scene = loadAsIs(f);
        EXPECT_EQ(std::ranges::count(scene.notes, c.note), 1) << c.note << "\n" << Json(scene.notes).dump(1);
        EXPECT_EQ(f.only(scene).positions, corners) << c.note;
        EXPECT_EQ(scene.meshes.at(1).primitives.size(), 0u) << c.note;
        EXPECT_EQ(poseAt(scene, 0).instances.size(), 1u) << c.note;
        f.json["scenes"][0]["nodes"] = {1};
        EXPECT_EQ(errorAsIs(f), c.line);
    }
    // One of two primitives.
    GltfFile f = GltfFile::triangle();
    f.json["meshes"][0]["primitives"].push_back(f.primitive());
    f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 1, 7}, UBYTE, "SCALAR", 1);
    const Scene scene = f.load();
    EXPECT_EQ(scene.notes,
              Lines{"mesh 0, primitive 0: index 2 of its indices is 7, past its 3 vertices: left out"});
    EXPECT_EQ(f.only(scene).positions, corners);
    // Weights of a node whose mesh is skipped are not another fault.
    GltfFile w = GltfFile::triangle();
    w.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 7}}}}}}});
    w.json["nodes"].push_back({{"mesh", 1}, {"weights", {1}}});
    w.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(w.error(), "");
}

// Parts that depend on a broken part are broken, too: an animation over a broken accessor over a broken
// view.
TEST(GltfRepair, WhatNeedsABrokenThingIsLeftOutWithIt) {
    GltfFile f = GltfFile::triangle();
    const int times = f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
    f.json["bufferViews"][1]["byteLength"] = -8;
    f.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", times}}}}, {"channels", Json::array()}}};
    const Scene scene = f.load();
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_EQ(scene.notes,
              (Lines{"bufferView 1: byteLength is -8, not at least 0: left out",
                     "accessor 1: left out, it needs bufferView 1: byteLength is -8, not at least 0",
                     "animation 0: left out, it needs bufferView 1: byteLength is -8, not at least 0"}));
}

TEST(GltfRepair, MaterialsThatNothingIsDrawnWithOpenNoImage) {
    GltfFile f = GltfFile::triangle();
    f.json["images"] = {{{"uri", "missing.png"}}};
    f.json["samplers"] = {{{"wrapS", 1}}};
    f.json["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
    f.json["materials"] = {{{"name", "spare"}, {"normalTexture", {{"index", 0}}}},
                           {{"name", "broken"}, {"normalTexture", {{"index", 1}}}}};
    const Scene scene = f.load();
    EXPECT_EQ(scene.notes, Lines{"sampler 0: 1 is not a wrap mode: left out, the scene does not use it"});
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(scene.materials.at(0).normal_texture.texture, -1);
    EXPECT_EQ(scene.materials.at(1).name, "broken");
    f.primitive()["material"] = 0;
    EXPECT_TRUE(f.error().ends_with(": image 0: missing.png: no such file"));
    f.json["images"][0].erase("uri");
    EXPECT_TRUE(f.error().ends_with(": image 0: has no uri or bufferView")) << f.error();
}

// ---- odd JSON ----------------------------------------------------------------------------------------

TEST(GltfRepair, NullIsAbsent) {
    GltfFile f = GltfFile::triangle();
    f.json["animations"] = nullptr;
    f.json["extensionsRequired"] = nullptr;
    f.json["nodes"][0]["children"] = nullptr;
    f.primitive()["indices"] = nullptr;
    f.primitive()["attributes"]["NORMAL"] = nullptr;
    f.primitive()["extensions"]["KHR_draco_mesh_compression"] = nullptr;
    f.json["extras"] = nullptr;  // has no content
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions, corners);
    EXPECT_EQ(scene.notes,
              (Lines{"animations is null: ignored", "extensionsRequired is null: ignored",
                     "mesh 0, primitive 0: attributes: NORMAL is null: ignored",
                     "mesh 0, primitive 0: KHR_draco_mesh_compression is null: ignored",
                     "mesh 0, primitive 0: indices is null: ignored", "node 0: children is null: ignored"}));
    f.primitive()["attributes"] = nullptr;
    EXPECT_TRUE(f.error().ends_with(": mesh 0, primitive 0: has no attributes")) << f.error();
}

TEST(GltfRepair, NamesThatAreNoTextAreLeftOut) {
    GltfFile f = GltfFile::triangle();
    f.json["nodes"][0]["name"] = 7;
    f.json["meshes"][0]["name"] = {"a"};
    const Scene scene = f.load();
    EXPECT_EQ(scene.nodes[0].name, "");
    EXPECT_EQ(scene.notes, (Lines{"mesh 0: name is an array, not text: left out",
                                  "node 0: name is 7, not text: left out"}));
}

TEST(GltfRepair, ExtensionsAreNotedWhereverTheyStand) {
    GltfFile f = GltfFile::triangle();
    const auto with = [](const char* name) { return Json{{name, Json::object()}}; };
    f.json["samplers"] = {{{"extensions", with("EXT_a")}}};
    f.json["textures"] = {{{"extensions", with("EXT_b")}}};
    f.json["meshes"][0]["extensions"] = with("EXT_c");
    f.json["scenes"][0]["extensions"] = with("EXT_d");
    f.json["materials"] = {{{"pbrMetallicRoughness", {{"extensions", with("EXT_e")}}}},
                           {{"extensions", with("EXT_a")}}};
    f.json["animations"] = {
        {{"samplers", Json::array()},
         {"channels", {{{"sampler", 0}, {"target", {{"path", "pointer"}, {"extensions", with("EXT_f")}}}}}}}};
    f.json["asset"]["extensions"] = with("EXT_g");
    // A supported extension that does not belong in a node.
    f.json["nodes"][0]["extensions"] = with("KHR_texture_transform");
    Lines expected;
    for (const char letter : std::string("abcdefg"))
        expected.push_back(fmt::format("EXT_{}: left out, not supported", letter));
    expected.push_back("node 0: KHR_texture_transform is not supported there: left out");
    EXPECT_EQ(f.load().notes, expected);
}

TEST(GltfRepair, ExtensionsMissingFromExtensionsUsedAreNoted) {
    GltfFile f = GltfFile::triangle();
    f.json["materials"] = {{{"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    f.primitive()["material"] = 0;
    f.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 0}, {"variants", {0}}}};
    f.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "a"}}};
    f.json["extensionsUsed"] = {"KHR_lights_punctual"};
    EXPECT_EQ(f.load().notes, (Lines{"KHR_materials_unlit: is used but missing from extensionsUsed",
                                     "KHR_materials_variants: is used but missing from extensionsUsed"}));
    f.json.erase("extensionsUsed");  // the builder lists all
    EXPECT_EQ(f.load().notes, Lines());
}

TEST(GltfRepair, NewerVersionsAreRefusedByName) {
    GltfFile f = GltfFile::triangle();
    f.json["asset"]["version"] = "2.7";
    f.json["asset"]["minVersion"] = "2.0";
    EXPECT_EQ(f.error(), "");
    for (const char* version : {"2.1", "3.0", "10.0", "two"}) {
        f.json["asset"]["minVersion"] = version;
        EXPECT_TRUE(
            f.error().ends_with(std::string(": asset: minVersion ") + version + " is not supported; 2.0 is"))
            << f.error();
    }
}
