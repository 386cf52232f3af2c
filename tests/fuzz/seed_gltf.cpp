// SPDX-License-Identifier: MIT
// Scenes that use as much of glTF 2.0 as fits into a few kilobytes.
#include "tests/fuzz/base64.h"
#include "tests/fuzz/seeds.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>

namespace diptych::fuzz {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

constexpr int BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126;

// A 2 x 1 PNG.
constexpr const char* twoPixels =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR4nGP4z8DwHwgbABB5A359Y87XAAAAAElFTkSuQmCC";

struct Maker {
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::string data;

    template <class T>
    int view(std::initializer_list<T> values) {
        data.resize((data.size() + 3) / 4 * 4);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", values.size() * sizeof(T)}});
        data.append(reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T));
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }
    template <class T>
    int accessor(int componentType, const char* type, std::size_t width, std::initializer_list<T> values,
                 bool normalized = false) {
        json["accessors"].push_back({{"bufferView", view(values)},
                                     {"componentType", componentType},
                                     {"count", values.size() / width},
                                     {"type", type},
                                     {"normalized", normalized}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    std::string text() {
        json["buffers"] = {
            {{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
        return json.dump();
    }
    std::string binary() {
        json["buffers"] = {{{"byteLength", data.size()}}};
        std::string head = json.dump(), body = data;
        head.resize((head.size() + 3) / 4 * 4, ' ');
        body.resize((body.size() + 3) / 4 * 4);
        const auto word = [](std::size_t value) {
            std::string bytes;
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
            return bytes;
        };
        return "glTF" + word(2) + word(28 + head.size() + body.size()) + word(head.size()) + "JSON" + head +
               word(body.size()) + std::string("BIN\0", 4) + body;
    }
};

// A triangle with every attribute, skinned, morphed and animated.
Maker moved() {
    Maker m;
    Json attributes;
    attributes["POSITION"] = m.accessor<float>(FLOAT, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    attributes["NORMAL"] = m.accessor<float>(FLOAT, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    attributes["TANGENT"] = m.accessor<float>(FLOAT, "VEC4", 4, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1});
    attributes["TEXCOORD_0"] = m.accessor<float>(FLOAT, "VEC2", 2, {0, 0, 1, 0, 0, 1});
    attributes["TEXCOORD_1"] = m.accessor<std::uint16_t>(USHORT, "VEC2", 2, {0, 0, 65535, 0, 0, 65535}, true);
    attributes["COLOR_0"] =
        m.accessor<std::uint8_t>(UBYTE, "VEC4", 4, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 128}, true);
    attributes["JOINTS_0"] = m.accessor<std::uint8_t>(UBYTE, "VEC4", 4, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    attributes["WEIGHTS_0"] = m.accessor<float>(FLOAT, "VEC4", 4, {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const Json target = {{"POSITION", m.accessor<float>(FLOAT, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1})},
                         {"NORMAL", m.accessor<float>(FLOAT, "VEC3", 3, {1, 0, 0, 1, 0, 0, 1, 0, 0})}};
    const int indices = m.accessor<std::uint8_t>(UBYTE, "SCALAR", 1, {0, 1, 2});
    m.json["meshes"] = {
        {{"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"targets", {target}}, {"mode", 4}}}},
         {"weights", {0.25}}}};
    const int binds = m.accessor<float>(FLOAT, "MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1});
    m.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}, {"skeleton", 1}}};
    m.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
                       {{"children", {2}}, {"translation", {0, 1, 0}}, {"rotation", {0, 0, 0, 1}}},
                       {{"scale", {-1, 1, 1}}}};
    m.json["scenes"] = {{{"nodes", {0, 1}}}};
    const int times = m.accessor<float>(FLOAT, "SCALAR", 1, {0, 1});
    const int turns = m.accessor<std::int16_t>(SHORT, "VEC4", 4, {0, 0, 0, 32767, 0, 0, 32767, 0}, true);
    const int moves =
        m.accessor<float>(FLOAT, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
    const int weights = m.accessor<float>(FLOAT, "SCALAR", 1, {0, 1});
    m.json["animations"] = {{{"samplers",
                              {{{"input", times}, {"output", turns}},
                               {{"input", times}, {"output", moves}, {"interpolation", "CUBICSPLINE"}},
                               {{"input", times}, {"output", weights}, {"interpolation", "STEP"}}}},
                             {"channels",
                              {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
                               {{"sampler", 1}, {"target", {{"node", 2}, {"path", "translation"}}}},
                               {{"sampler", 2}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    return m;
}

// Primitives without normals in every mode; materials, textures and lights with every extension.
Maker dressed() {
    Maker m;
    const int positions =
        m.accessor<std::int16_t>(SHORT, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, true);
    m.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", m.view<std::uint16_t>({3})}, {"componentType", USHORT}}},
        {"values", {{"bufferView", m.view<std::int16_t>({1, 2, 3, 0})}}}};
    const int texcoords = m.accessor<std::int8_t>(BYTE, "VEC2", 2, {0, 0, 1, 0, 0, 1, 1, 1});
    const int indices = m.accessor<std::uint32_t>(UINT, "SCALAR", 1, {0, 1, 2, 3});
    Json primitives = Json::array();
    for (int mode = 0; mode <= 6; ++mode)
        primitives.push_back({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", texcoords}}},
                              {"indices", indices},
                              {"mode", mode},
                              {"material", mode % 2}});
    m.json["meshes"] = {{{"primitives", primitives}}};
    const Json transform = {
        {"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"rotation", 1}, {"scale", {2, -1}}, {"texCoord", 1}}}};
    const Json texture = {{"index", 0}, {"texCoord", 0}, {"extensions", transform}};
    m.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", texture},
           {"baseColorFactor", {1, 0.5, 0.25, 1}},
           {"metallicRoughnessTexture", texture},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.25}}},
         {"normalTexture", {{"index", 0}, {"scale", 2}}},
         {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}},
         {"emissiveTexture", texture},
         {"emissiveFactor", {1, 1, 1}},
         {"doubleSided", true},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}},
           {"KHR_materials_ior", {{"ior", 1.4}}},
           {"KHR_materials_specular",
            {{"specularFactor", 0.5},
             {"specularTexture", texture},
             {"specularColorFactor", {1, 0.5, 1}},
             {"specularColorTexture", texture}}}}}},
        {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    m.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}};
    m.json["images"] = {{{"uri", std::string("data:image/png;base64,") + twoPixels}}};
    m.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    m.json["cameras"] = {
        {{"type", "perspective"},
         {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 10}, {"aspectRatio", 2}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}}};
    m.json["extensionsUsed"] = {"KHR_lights_punctual",  "KHR_materials_emissive_strength",
                                "KHR_materials_ior",    "KHR_materials_specular",
                                "KHR_materials_unlit",  "KHR_mesh_quantization",
                                "KHR_texture_transform"};
    m.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    m.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"range", 10}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    const auto light = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
    m.json["nodes"] = {
        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"children", {1, 2}}},
        {{"camera", 0}, {"extensions", light(0)}},
        {{"camera", 1}, {"extensions", light(1)}},
        {{"name", "lamp"}, {"extensions", light(2)}}};
    m.json["scenes"] = {{{"nodes", {0}}, {"name", "one"}}, {{"nodes", {3}}}};
    return m;
}

}  // namespace

void writeGltfSeeds(const fs::path& out) {
    writeSeed(out, "gltf", "moved.gltf", moved().text());
    writeSeed(out, "gltf", "moved.glb", moved().binary());
    writeSeed(out, "gltf", "dressed.gltf", dressed().text());
    writeSeed(out, "gltf", "dressed.glb", dressed().binary());
}

}  // namespace diptych::fuzz
