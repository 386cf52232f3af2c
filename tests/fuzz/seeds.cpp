// SPDX-License-Identifier: MIT
// fuzz_seeds OUT [ASSETS]
#include "tests/fuzz/seeds.h"

#include "shared/frame/settings.h"
#include "tests/fuzz/base64.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace diptych::fuzz {

namespace fs = std::filesystem;

namespace {

std::string contentsOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// The file with all its available external files embedded.
std::string selfContained(const fs::path& file) {
    using Json = nlohmann::json;
    Json json = Json::parse(contentsOf(file), nullptr, false);
    if (!json.is_object()) return contentsOf(file);
    for (const char* kind : {"buffers", "images"})
        if (json.contains(kind) && json[kind].is_array())
            for (Json& object : json[kind]) {
                if (!object.is_object() || !object.contains("uri") || !object["uri"].is_string()) continue;
                const std::string uri = object["uri"];
                const fs::path beside = file.parent_path() / uri;
                std::error_code error;
                if (uri.starts_with("data:") || !fs::is_regular_file(beside, error)) continue;
                const std::string ending = beside.extension();
                const std::string type = ending == ".png"    ? "image/png"
                                         : ending == ".jpg"  ? "image/jpeg"
                                         : ending == ".webp" ? "image/webp"
                                                             : "application/octet-stream";
                object["uri"] = "data:" + type + ";base64," + base64(contentsOf(beside));
            }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void writeSeed(const fs::path& out, const char* target, std::string_view name, std::string_view bytes) {
    if (bytes.size() > largest_seed) return;
    fs::create_directories(out / target);
    std::ofstream(out / target / name, std::ios::binary) << bytes;
}

void writeTextSeeds(const fs::path& out) {
    writeSeed(out, "settings", "default.json", toJson(Settings{}));
    writeSeed(out, "settings", "inside.json", "{\"settings\": " + toJson(Settings{}, -1) + "}");
    writeSeed(out, "settings", "words.json",
              R"({"size": "320x200", "ambient": "off", "camera": 2, "seed": 4294967295, "prepass": "auto",
 "time": 1e3, "light_cutoff": "none", "sort": "off", "env": "a.hdr", "lights": "point:64,spot:16"})");
    writeSeed(
        out, "lights", "all.json",
        R"({"lights": [{"type": "directional", "name": "sun", "direction": [0, -1, 0.5], "intensity": 3},
 {"type": "point", "position": [1, 2, 3], "color": [1, 0.5, 0.25], "range": 10},
 {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.7853981633974483},
  "extras": {"a": []}},
 {"type": "spot", "innerConeAngle": 0, "outerConeAngle": 1.5707963267948966,
  "direction": [1e-200, 0, 0]}]})");
    writeSeed(out, "lights", "area.json",
              R"({"lights": [{"type": "rect", "size": [2, 0.5], "direction": [0, -1, 0], "axis": [1, 1, 0],
  "twoSided": true, "intensity": 1000, "range": 8},
 {"type": "disc", "radius": 0.5, "position": [0, 2, 0]},
 {"type": "tube", "length": 1.2, "radius": 0.02, "axis": [0, 0, 1]},
 {"type": "directional", "angle": 0.0093, "direction": [0, -1, 0]}]})");
    writeSeed(out, "lights", "none.json", R"({"lights": []})");
    writeSeed(
        out, "ours", "list.json",
        R"({"schema": 1, "software": "diptych", "files": ["index.html", "b/lit.png"], "errors": [[{}]]})");
    writeSeed(out, "ours", "plan.json", R"({"files": ["a.png", "b/c.png"], "earlier": ["d.section.js"]})");
    writeSeed(out, "list", "scenes",
              "# scenes\nbuiltin:points\n  scene.glb # here\n@other\n*.glb\n[a-s]*?scene=1\n");
}

int copySeeds(const fs::path& assets, const fs::path& out) {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        if (!entry.is_regular_file() || entry.file_size() > largest_seed) continue;
        const fs::path& file = entry.path();
        const std::string ending = file.extension(), name = "asset-" + std::to_string(count) + ending;
        if (ending == ".gltf")
            writeSeed(out, "gltf", name, selfContained(file));
        else if (ending == ".glb")
            writeSeed(out, "gltf", name, contentsOf(file));
        else if (ending == ".jpg" || ending == ".webp")
            writeSeed(out, "texture", name, contentsOf(file));
        else if (ending == ".exr")
            writeSeed(out, "exr", name, contentsOf(file));
        else if (ending == ".pfm")
            writeSeed(out, "pfm", name, contentsOf(file));
        else if (ending == ".hdr")
            writeSeed(out, "hdr", name, contentsOf(file));
        else if (ending == ".png")
            for (const char* target : {"png", "texture"}) writeSeed(out, target, name, contentsOf(file));
        else
            continue;
        ++count;
    }
    return count;
}

}  // namespace diptych::fuzz

int main(int count, char** arguments) {
    namespace fs = std::filesystem;
    using namespace diptych::fuzz;
    if (count < 2) return std::fprintf(stderr, "fuzz_seeds OUT [ASSETS]\n"), 2;
    fs::remove_all(arguments[1]);
    writeImageSeeds(arguments[1]);
    writeExrSeeds(arguments[1]);
    writeGltfSeeds(arguments[1]);
    writeTextSeeds(arguments[1]);
    if (count > 2 && fs::is_directory(arguments[2]))
        std::printf("seeds: built-in ones and %d of the assets\n", copySeeds(arguments[2], arguments[1]));
    else
        std::printf("seeds: built-in ones, no assets\n");
    return 0;
}
