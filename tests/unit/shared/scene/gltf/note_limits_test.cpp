// SPDX-License-Identifier: MIT
#include "tests/unit/shared/scene/gltf/as_is.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

// The reader shows the first 20 notes of each kind; another line counts the rest.
TEST(GltfNoteLimits, OfOneKindAreFew) {
    const auto add = [](const char* to, const std::string& value) {
        return [=](GltfFile& f) { f.json[Json::json_pointer(to)].push_back(Json::parse(value)); };
    };
    // Adds a node with this content to the scene.
    const auto node = [](const std::string& value) {
        return [=](GltfFile& f) {
            f.json["scenes"][0]["nodes"].push_back(f.json["nodes"].size());
            f.json["nodes"].push_back(Json::parse(value));
        };
    };
    const auto keyed = [](const char* to, const char* value) {
        return [=](GltfFile& f) {
            Json& object = f.json[Json::json_pointer(to)];
            object[fmt::format("EXT_{}", object.size())] = Json::parse(value);
        };
    };
    const std::pair<const char*, std::function<void(GltfFile&)>> kinds[] = {
        {"animations", add("/animations", R"({"samplers": [{"input": 0, "output": 0}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]})")},
        {"buffers", add("/buffers", R"({"byteLength": 4})")},
        {"bufferViews", add("/bufferViews", R"({"buffer": 0, "byteLength": 100})")},
        {"extensions", keyed("/extensions", "{}")},
        {"instances", node(R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}})")},
        {"lightmaps", add("/materials", R"({"extras": {"diptych": {"unknown": 1}}})")},
        {"material variants", add("/extensions/KHR_materials_variants/variants", "{}")},
        {"materials", add("/materials", R"({"pbrMetallicRoughness": {"metallicFactor": 2}})")},
        {"meshes", add("/meshes/0/primitives", R"({"attributes": {"POSITION": 0}, "mode": 1})")},
        {"nodes", node(R"({"rotation": [0, 0, 0, 0]})")},
        {"objects", add("/materials", R"({"doubleSided": 0})")},
        {"skins",
         [node](GltfFile& f) {
             f.json["skins"] = {{{"joints", {0}}}};
             node(R"({"mesh": 0, "skin": 0})")(f);
         }},
        {"lights and cameras",
         [node](GltfFile& f) {
             Json& lights = f.json["extensions"]["KHR_lights_punctual"]["lights"];
             node(fmt::format(R"({{"extensions": {{"KHR_lights_punctual": {{"light": {}}}}}}})",
                              lights.size()))(f);
             lights.push_back({{"type", "point"}, {"intensity", -1}});
         }},
        {"images",
         [](GltfFile& f) {
             const std::size_t i = f.json["images"].size();
             f.json["images"].push_back({{"uri", std::string(twoPixels) + "=AAAA"}});
             f.json["textures"].push_back({{"source", i}});
             f.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
             f.json["meshes"][0]["primitives"].push_back(
                 {{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", i}});
         }},
    };
    for (const auto& [kind, change] : kinds) {
        for (const std::size_t count : {20, 21, 23}) {
            GltfFile f = GltfFile::triangle();
            f.accessor<float>({0, 0, 0, 0, 0, 0}, FLOAT, "VEC2", 2);
            f.written();
            for (std::size_t i = 0; i < count; ++i) change(f);
            const std::vector<std::string> notes = loadAsIs(f).notes;
            ASSERT_EQ(notes.size(), std::min<std::size_t>(count, 21)) << kind << Json(notes).dump(1);
            const std::string counted =
                fmt::format("{} more {} about {}", count - 20, count == 21 ? "note" : "notes", kind);
            EXPECT_EQ(std::ranges::count(notes, counted), count > 20 ? 1 : 0) << kind << notes.back();
        }
    }
}
