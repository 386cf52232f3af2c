// SPDX-License-Identifier: MIT
// A small valid glTF file, of which a test changes one thing.
#pragma once

#include "shared/scene/load.h"
#include "shared/scene/model/scene.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// glTF component types.
constexpr int BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126;

// A file under construction: buffer 0 grows, and each accessor gets its own buffer view.
struct GltfFile {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"scene", 0}};
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

    // One triangle at z = 0, facing +Z, in mesh 0 of node 0.
    static GltfFile triangle() {
        GltfFile f;
        const int positions = f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
        f.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        f.json["nodes"] = {{{"mesh", 0}}};
        return f;
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    // The file's JSON, with the extensions of all objects in extensionsUsed unless the test wrote it.
    nlohmann::json declared() const {
        if (json.contains("extensionsUsed")) return json;
        std::set<std::string> names;
        const auto collect = [&](const auto& self, const nlohmann::json& value) -> void {
            for (const auto& [key, member] : value.items()) {
                if (value.is_object() && key == "extras") continue;
                if (value.is_object() && key == "extensions" && member.is_object())
                    for (const auto& extension : member.items()) names.insert(extension.key());
                if (member.is_structured()) self(self, member);
            }
        };
        collect(collect, json);
        nlohmann::json result = json;
        if (!names.empty()) result["extensionsUsed"] = names;
        return result;
    }

    std::string written(const std::string& name = "scene.gltf") {
        if (!data.empty()) {
            json["buffers"] = {{{"byteLength", data.size()}, {"uri", "a%20buffer.bin"}}};
            std::ofstream(testFolder() / "a buffer.bin", std::ios::binary) << data;
        }
        std::ofstream(testFolder() / name) << declared().dump();
        return (testFolder() / name).string();
    }

    std::string binary() {
        json["buffers"] = {{{"byteLength", data.size()}}};
        std::string text = declared().dump(), bytes = data;
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
        return faultOf([&] { load(); });
    }
};

// Changes to a file's JSON; `pointer` as in RFC 6901.
using GltfChange = std::function<void(GltfFile&)>;
inline GltfChange sets(const std::string& pointer, nlohmann::json value) {
    return [pointer, value = std::move(value)](GltfFile& f) {
        f.json[nlohmann::json::json_pointer(pointer)] = value;
    };
}
inline GltfChange erases(const std::string& pointer, const std::string& key) {
    return [=](GltfFile& f) { f.json.at(nlohmann::json::json_pointer(pointer)).erase(key); };
}

// The error of loading these bytes as a file; empty if it loads.
inline std::string loadBytes(const std::string& bytes, const char* name = "scene.glb") {
    std::ofstream(testFolder() / name, std::ios::binary) << bytes;
    return faultOf([&] { loadScene((testFolder() / name).string()); });
}

inline bool mentions(const std::vector<std::string>& notes, const std::string& text) {
    for (const std::string& note : notes)
        if (note.find(text) != note.npos) return true;
    return false;
}

// A 2 x 1 PNG: red and half-transparent green; 8 bits, no filter.
inline const char* const twoPixels =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAA"
    "D0lEQVR4nGP4z8DwHwgbABB5A359Y87XAAAAAElFTkSuQmCC";

}  // namespace diptych
