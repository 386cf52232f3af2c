// SPDX-License-Identifier: MIT
// Scenes that use as much of glTF 2.0 as fits into a few kilobytes.
#include "tests/fuzz/base64.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/draco_builder.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace diptych::fuzz {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

// The file as text, with its buffer embedded.
std::string textOf(GltfFile f) {
    f.json["buffers"] = {
        {{"byteLength", f.data.size()}, {"uri", "data:application/octet-stream;base64," + base64(f.data)}}};
    return f.json.dump();
}

template <class T>
int viewOf(GltfFile& f, const std::vector<T>& values) {
    f.data.resize((f.data.size() + 3) / 4 * 4);
    return diptych::viewOf(f, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

// A triangle with every attribute, skinned, morphed and animated.
GltfFile moved() {
    GltfFile m;
    Json attributes;
    attributes["POSITION"] = m.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
    attributes["NORMAL"] = m.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    attributes["TANGENT"] = m.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, FLOAT, "VEC4", 4);
    attributes["TEXCOORD_0"] = m.accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC2", 2);
    attributes["TEXCOORD_1"] = m.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, USHORT, "VEC2", 2, true);
    attributes["COLOR_0"] =
        m.accessor<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 128}, UBYTE, "VEC4", 4, true);
    attributes["JOINTS_0"] = m.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, UBYTE, "VEC4", 4);
    attributes["WEIGHTS_0"] = m.accessor<float>({0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, FLOAT, "VEC4", 4);
    const Json target = {{"POSITION", m.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3)},
                         {"NORMAL", m.accessor<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}, FLOAT, "VEC3", 3)}};
    const int indices = m.accessor<std::uint8_t>({0, 1, 2}, UBYTE, "SCALAR", 1);
    m.json["meshes"] = {
        {{"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"targets", {target}}, {"mode", 4}}}},
         {"weights", {0.25}}}};
    const int binds = m.accessor<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1},
        FLOAT, "MAT4", 16);
    m.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}, {"skeleton", 1}}};
    m.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
                       {{"children", {2}}, {"translation", {0, 1, 0}}, {"rotation", {0, 0, 0, 1}}},
                       {{"scale", {-1, 1, 1}}}};
    m.json["scenes"] = {{{"nodes", {0, 1}}}};
    const int times = m.accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
    const int turns = m.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, SHORT, "VEC4", 4, true);
    const int moves =
        m.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0}, FLOAT, "VEC3", 3);
    const int weights = m.accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
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
GltfFile dressed() {
    GltfFile m;
    const int positions =
        m.accessor<std::int16_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, SHORT, "VEC3", 3, true);
    m.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", viewOf<std::uint16_t>(m, {3})}, {"componentType", USHORT}}},
        {"values", {{"bufferView", viewOf<std::int16_t>(m, {1, 2, 3, 0})}}}};
    const int texcoords = m.accessor<std::int8_t>({0, 0, 1, 0, 0, 1, 1, 1}, BYTE, "VEC2", 2);
    const int indices = m.accessor<std::uint32_t>({0, 1, 2, 3}, UINT, "SCALAR", 1);
    Json primitives = Json::array();
    for (int mode = 0; mode <= 6; ++mode)
        primitives.push_back({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", texcoords}}},
                              {"indices", indices},
                              {"mode", mode},
                              {"material", mode % 3}});
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
             {"specularColorTexture", texture}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.5},
             {"clearcoatTexture", texture},
             {"clearcoatRoughnessFactor", 0.25},
             {"clearcoatRoughnessTexture", texture},
             {"clearcoatNormalTexture", {{"index", 0}, {"scale", 2}}}}},
           {"KHR_materials_anisotropy",
            {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1}, {"anisotropyTexture", texture}}},
           {"KHR_materials_sheen",
            {{"sheenColorFactor", {1, 0.5, 0.25}},
             {"sheenColorTexture", texture},
             {"sheenRoughnessFactor", 0.5},
             {"sheenRoughnessTexture", texture}}},
           {"KHR_materials_iridescence",
            {{"iridescenceFactor", 0.5},
             {"iridescenceTexture", texture},
             {"iridescenceIor", 1.5},
             {"iridescenceThicknessMinimum", 50},
             {"iridescenceThicknessMaximum", 500},
             {"iridescenceThicknessTexture", texture}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", texture}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 0.5},
             {"thicknessTexture", texture},
             {"attenuationDistance", 2},
             {"attenuationColor", {1, 0.5, 0}}}},
           {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
           {"KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.5},
             {"diffuseTransmissionTexture", texture},
             {"diffuseTransmissionColorFactor", {1, 0.5, 0}},
             {"diffuseTransmissionColorTexture", texture}}}}}},
        {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}},
        {{"extensions",
          {{"KHR_materials_pbrSpecularGlossiness",
            {{"diffuseFactor", {1, 0.5, 0.25, 1}},
             {"diffuseTexture", texture},
             {"specularFactor", {0.5, 0.5, 1}},
             {"specularGlossinessTexture", texture},
             {"glossinessFactor", 0.5}}}}}}};
    m.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}};
    m.json["images"] = {{{"uri", twoPixels}}};
    m.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    m.json["cameras"] = {
        {{"type", "perspective"},
         {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 10}, {"aspectRatio", 2}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}}};
    m.json["extensionsUsed"] = {"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
                                "KHR_materials_specular",     "KHR_materials_clearcoat",
                                "KHR_materials_anisotropy",   "KHR_materials_sheen",
                                "KHR_materials_iridescence",  "KHR_materials_unlit",
                                "KHR_materials_transmission", "KHR_materials_volume",
                                "KHR_materials_dispersion",   "KHR_materials_diffuse_transmission",
                                "KHR_mesh_quantization",      "KHR_texture_transform"};
    m.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    m.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}, {"extras", {{"diptych", {{"angle", 0.0093}}}}}},
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"range", 10}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    const auto light = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
    m.json["nodes"] = {
        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"children", {1, 2}}},
        {{"camera", 0}, {"extensions", light(0)}},
        {{"camera", 1}, {"extensions", light(1)}},
        {{"name", "lamp"}, {"extensions", light(2)}}};
    m.json["scenes"] = {{{"nodes", {0}}, {"name", "one"}}, {{"nodes", {3}}}};
    m.json["scenes"][0]["extras"]["diptych"]["lights"] = {
        {{"type", "rect"}, {"node", 2}, {"size", {2, 1}}, {"axis", {0, 1, 0}}, {"twoSided", true}},
        {{"type", "disc"}, {"radius", 0.5}, {"position", {0, 2, 0}}, {"direction", {0, -1, 0}}},
        {{"type", "tube"}, {"node", 1}, {"length", 1.5}, {"radius", 0.02}, {"intensity", 900}}};
    return m;
}

// As `dressed`, with pointers to every kind of property, and instanced.
GltfFile pointed() {
    GltfFile m = dressed();
    const auto extension = [](const std::string& pointer) {
        return Json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    };
    // Two keys at the same time.
    const int times = m.accessor<float>({0, 1, 1}, FLOAT, "SCALAR", 1);
    const int outputs[] = {m.accessor<std::uint16_t>({0, 30000, 65535}, USHORT, "SCALAR", 1, true),
                           m.accessor<float>({0, 1, 2, 3, 4, 5}, FLOAT, "VEC2", 2),
                           m.accessor<float>({0, 0, 0, 1, 1, 1, 2, 2, 2}, FLOAT, "VEC3", 3),
                           m.accessor<float>({0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1}, FLOAT, "VEC4", 4)};
    Json samplers = Json::array(), channels = Json::array();
    for (const int output : outputs)
        samplers.push_back({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
    const std::pair<int, const char*> pointers[] = {
        {2, "/nodes/3/translation"},
        {3, "/nodes/1/rotation"},
        {0, "/extensions/KHR_lights_punctual/lights/1/range"},
        {0, "/extensions/KHR_lights_punctual/lights/2/spot/innerConeAngle"},
        {2, "/extensions/KHR_lights_punctual/lights/0/color"},
        {0, "/cameras/0/perspective/znear"},
        {0, "/cameras/1/orthographic/zfar"},
        {3, "/materials/0/pbrMetallicRoughness/baseColorFactor"},
        {2, "/materials/0/emissiveFactor"},
        {0, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength"},
        {0, "/materials/0/extensions/KHR_materials_ior/ior"},
        {0, "/materials/0/extensions/KHR_materials_transmission/transmissionFactor"},
        {2, "/materials/0/extensions/KHR_materials_sheen/sheenColorFactor"},
        {0, "/materials/0/extensions/KHR_materials_volume/attenuationDistance"},
        {2, "/materials/0/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor"},
        {0, "/materials/0/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum"},
        {0, "/materials/0/normalTexture/scale"},
        {1, "/materials/0/emissiveTexture/extensions/KHR_texture_transform/offset"},
        {0, "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation"}};
    for (const auto& [sampler, pointer] : pointers)
        channels.push_back({{"sampler", sampler}, {"target", extension(pointer)}});
    m.json["animations"] = {{{"samplers", samplers}, {"channels", channels}, {"name", "all"}}};
    m.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", m.accessor<float>({0, 0, 0, 1, 0, 0}, FLOAT, "VEC3", 3)},
        {"ROTATION", m.accessor<std::int8_t>({0, 0, 0, 127, 0, 127, 0, 0}, BYTE, "VEC4", 4, true)},
        {"SCALE", m.accessor<float>({1, 1, 1, 2, 2, 2}, FLOAT, "VEC3", 3)}};
    return m;
}

// Positions and indices as meshoptimizer streams.
GltfFile packed() {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<unsigned> indices{0, 1, 2, 2, 1, 3};
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 4, 12));
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(6, 4));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), 6));

    GltfFile m = GltfFile::triangle();
    const auto accessor = [&](const std::vector<unsigned char>& stream, const char* mode, int count,
                              int stride, int componentType, const char* type) {
        const int packed = viewOf(m, stream);
        Json extension = m.json["bufferViews"][static_cast<std::size_t>(packed)];
        extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
        m.json["bufferViews"].push_back({{"buffer", 0},
                                         {"byteLength", count * stride},
                                         {"extensions", {{"EXT_meshopt_compression", extension}}}});
        m.json["accessors"].push_back(
            {{"bufferView", packed + 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
        return m.json["accessors"].size() - 1;
    };
    m.primitive()["attributes"]["POSITION"] = accessor(vertices, "ATTRIBUTES", 4, 12, FLOAT, "VEC3");
    m.primitive()["indices"] = accessor(triangles, "TRIANGLES", 6, 4, UINT, "SCALAR");
    m.json["extensionsUsed"] = m.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return m;
}

// Two material variants.
GltfFile varied() {
    GltfFile m = GltfFile::triangle();
    m.json["materials"] = {{{"name", "blue"}}, {{"name", "red"}}};
    m.json["extensions"]["KHR_materials_variants"]["variants"] = m.json["materials"];
    m.primitive()["material"] = 0;
    Json& mappings = m.primitive()["extensions"]["KHR_materials_variants"]["mappings"];
    for (int i = 0; i < 2; ++i) mappings.push_back({{"material", i}, {"variants", Json::array({i})}});
    m.json["extensionsUsed"] = Json::array({"KHR_materials_variants"});
    return m;
}

}  // namespace

void writeGltfSeeds(const fs::path& out) {
    for (const auto& [name, file] :
         {std::pair{"moved", moved()},
          {"dressed", dressed()},
          {"pointed", pointed()},
          {"meshopt", packed()},
          {"variants", varied()},
          {"draco-sequential", compressed(encoded(2, {draco::MESH_SEQUENTIAL_ENCODING}))},
          {"draco-0", compressed(encoded(3, {draco::MESH_EDGEBREAKER_ENCODING, 0, 8}))},
          {"draco-5", compressed(encoded(3, {draco::MESH_EDGEBREAKER_ENCODING, 5, 8, true}))}}) {
        writeSeed(out, "gltf", name + std::string(".gltf"), textOf(file));
        writeSeed(out, "gltf", name + std::string(".glb"), GltfFile(file).binary());
    }
}

}  // namespace diptych::fuzz
