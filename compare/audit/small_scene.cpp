// SPDX-License-Identifier: MIT
#include "compare/audit/small_scene.h"

#include "compare/render/frame_facts.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/motion/pose.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace diptych::audit {

using Json = nlohmann::ordered_json;

namespace {

// RFC 4648.
std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : std::uint8_t{0});
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

// The buffer, views and accessors of a file.
class Buffers {
public:
    explicit Buffers(Json& gltf) : gltf_(gltf) { gltf_["accessors"] = gltf_["bufferViews"] = Json::array(); }
    // An accessor's number. `type`: "VEC3"; `component`: 5126 float, 5125 unsigned int.
    template <class T>
    std::size_t add(const std::vector<T>& values, const char* type, int component) {
        const std::size_t from = bytes_.size(), size = values.size() * sizeof(T);
        bytes_.resize(from + size);
        std::memcpy(bytes_.data() + from, values.data(), size);
        gltf_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", from}, {"byteLength", size}});
        gltf_["accessors"].push_back({{"bufferView", gltf_["bufferViews"].size() - 1},
                                      {"componentType", component},
                                      {"count", values.size()},
                                      {"type", type}});
        return gltf_["accessors"].size() - 1;
    }
    void bound(std::size_t accessor, const glm::vec3& least, const glm::vec3& most) {
        gltf_["accessors"][accessor]["min"] = {least.x, least.y, least.z};
        gltf_["accessors"][accessor]["max"] = {most.x, most.y, most.z};
    }
    // With the buffer inside the JSON, or for the binary chunk behind it.
    std::vector<std::uint8_t> close(bool inside) {
        Json buffer{{"byteLength", bytes_.size()}};
        if (inside) buffer["uri"] = "data:application/octet-stream;base64," + base64(bytes_);
        gltf_["buffers"] = Json::array({std::move(buffer)});
        return std::move(bytes_);
    }

private:
    Json& gltf_;
    std::vector<std::uint8_t> bytes_;
};

Json listOf(const double* values, int count) {
    Json list = Json::array();
    for (int i = 0; i < count; ++i) list.push_back(values[i]);
    return list;
}
Json listOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json jsonOf(const Material& material) {
    Json json{
        {"name", material.name},
        {"pbrMetallicRoughness",
         {{"baseColorFactor",
           {material.base_color.r, material.base_color.g, material.base_color.b, material.base_color.a}},
          {"metallicFactor", material.metallic},
          {"roughnessFactor", material.roughness}}},
        {"doubleSided", material.double_sided}};
    json["alphaMode"] = material.alpha_mode == AlphaMode::opaque ? "OPAQUE"
                        : material.alpha_mode == AlphaMode::mask ? "MASK"
                                                                 : "BLEND";
    if (material.alpha_mode == AlphaMode::mask) json["alphaCutoff"] = material.alpha_cutoff;
    Json& more = json["extensions"] = Json::object();
    more["KHR_materials_ior"] = {{"ior", material.ior}};
    more["KHR_materials_specular"] = {{"specularFactor", material.specular},
                                      {"specularColorFactor", listOf(glm::dvec3(material.specular_color))}};
    const float brightest = std::max({material.emissive.r, material.emissive.g, material.emissive.b, 0.0f});
    if (brightest > 0) {
        json["emissiveFactor"] = listOf(glm::dvec3(material.emissive) / double{brightest});
        more["KHR_materials_emissive_strength"] = {{"emissiveStrength", brightest}};
    }
    if (material.unlit) more["KHR_materials_unlit"] = Json::object();
    if (material.transmission > 0)
        more["KHR_materials_transmission"] = {{"transmissionFactor", material.transmission}};
    return json;
}

Json jsonOf(const Light& light) {
    Json json{{"type", nameOf(light.kind)},
              {"color", listOf(glm::dvec3(light.color))},
              {"intensity", light.intensity},
              {"position", listOf(light.position)}};
    if (light.kind != LightKind::point) json["direction"] = listOf(light.direction);
    if (std::isfinite(light.range)) json["range"] = light.range;
    if (light.kind == LightKind::directional) {
        if (light.angle > 0) json["angle"] = light.angle;
        json.erase("position");
    }
    if (light.kind == LightKind::spot)
        json["spot"] = {{"innerConeAngle", light.inner_cone}, {"outerConeAngle", light.outer_cone}};
    if (light.kind == LightKind::rect) json["size"] = {light.width, light.height};
    if (light.kind == LightKind::disc || light.kind == LightKind::tube) json["radius"] = light.radius;
    if (light.kind == LightKind::tube) json["length"] = light.length;
    if (light.kind == LightKind::rect || light.kind == LightKind::tube) json["axis"] = listOf(light.axis);
    if (light.kind == LightKind::rect || light.kind == LightKind::disc) json["twoSided"] = light.two_sided;
    if (light.shadow) json["shadow"] = true;
    if (light.kind == LightKind::tube) json.erase("direction");
    return json;
}

}  // namespace

std::optional<Case> flattened(const Case& whole) {
    const Pose pose = poseAt(whole.scene, whole.settings.time, whole.settings.animation);
    Case flat;
    flat.settings = whole.settings;
    flat.exposure = whole.exposure;
    flat.settings.time = 0;
    flat.settings.animation.clear();
    flat.settings.camera = "0";
    flat.settings.env = Settings().env;
    flat.settings.env_sun = false;
    Scene& scene = flat.scene;
    scene.name = whole.scene.name;
    scene.background = whole.scene.background;
    scene.lights = whole.scene.lights;
    scene.cameras = {whole.camera()};
    scene.materials = pose.materials.empty() ? whole.scene.materials : pose.materials;
    for (Material& material : scene.materials)
        for (TextureSlot* slot :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.occlusion_texture, &material.emissive_texture, &material.specular_texture,
              &material.specular_color_texture, &material.lightmap_texture})
            *slot = {};
    for (const Instance& instance : pose.instances) {
        if (instance.deformed()) return {};
        Primitive primitive = primitiveOf(whole.scene, instance);
        primitive.texcoords[0].clear();
        primitive.texcoords[1].clear();
        scene.nodes.push_back({.name = "part",
                               .parent_from_node = instance.world_from_object,
                               .mesh = static_cast<int>(scene.meshes.size())});
        scene.meshes.push_back({.name = "part", .primitives = {std::move(primitive)}});
    }
    return flat;
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) triangles += primitive.indices.size() / 3;
    return triangles;
}

std::vector<int> writtenMaterials(const Scene& scene) {
    std::vector<int> order;
    for (const Node& node : scene.nodes) {
        const Primitive& primitive = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives.front();
        if (!primitive.indices.empty() && std::ranges::count(order, primitive.material) == 0)
            order.push_back(primitive.material);
    }
    return order;
}

namespace {

struct Written {
    Json gltf;
    std::vector<std::uint8_t> bytes;  // of the buffer
};

Written writtenScene(const Case& flat, bool inside) {
    Json gltf{{"asset", {{"version", "2.0"}, {"generator", "diptych audit"}}}};
    gltf["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular",
                              "KHR_materials_emissive_strength", "KHR_materials_unlit",
                              "KHR_materials_transmission"};
    gltf["scene"] = 0;
    gltf["nodes"] = gltf["meshes"] = gltf["materials"] = Json::array();
    Buffers buffers(gltf);
    const std::vector<int> materials = writtenMaterials(flat.scene);
    for (const int material : materials)
        gltf["materials"].push_back(jsonOf(flat.scene.materials[static_cast<std::size_t>(material)]));
    for (const Node& node : flat.scene.nodes) {
        const Primitive& primitive =
            flat.scene.meshes[static_cast<std::size_t>(node.mesh)].primitives.front();
        if (primitive.indices.empty()) continue;
        const auto material = std::ranges::find(materials, primitive.material) - materials.begin();
        // Only the vertices that are used.
        Primitive used;
        for (const std::uint32_t i : primitive.indices) {
            used.indices.push_back(static_cast<std::uint32_t>(used.positions.size()));
            used.positions.push_back(primitive.positions[i]);
            used.normals.push_back(primitive.normals[i]);
            used.tangents.push_back(primitive.tangents[i]);
            if (!primitive.colors.empty()) used.colors.push_back(primitive.colors[i]);
        }
        const std::size_t positions = buffers.add(used.positions, "VEC3", 5126);
        glm::vec3 least = used.positions.front(), most = least;
        for (const glm::vec3& position : used.positions) {
            least = glm::min(least, position);
            most = glm::max(most, position);
        }
        buffers.bound(positions, least, most);
        Json attributes{{"POSITION", positions}, {"NORMAL", buffers.add(used.normals, "VEC3", 5126)}};
        if (!used.colors.empty()) attributes["COLOR_0"] = buffers.add(used.colors, "VEC4", 5126);
        gltf["meshes"].push_back(
            {{"primitives", Json::array({{{"attributes", attributes},
                                          {"indices", buffers.add(used.indices, "SCALAR", 5125)},
                                          {"material", material}}})}});
        gltf["nodes"].push_back({{"mesh", gltf["meshes"].size() - 1},
                                 {"matrix", listOf(glm::value_ptr(node.parent_from_node), 16)}});
    }
    const Camera& camera = flat.camera();
    Json lens{{"type", camera.orthographic ? "orthographic" : "perspective"}};
    const double aspect = static_cast<double>(flat.settings.size.width) / flat.settings.size.height;
    if (camera.orthographic)
        lens["orthographic"] = {{"xmag", camera.ymag * aspect},
                                {"ymag", camera.ymag},
                                {"znear", camera.near},
                                {"zfar", std::isfinite(camera.far) ? camera.far : 1e6 * camera.ymag}};
    else
        lens["perspective"] = {{"yfov", camera.yfov}, {"znear", camera.near}};
    if (!camera.orthographic && std::isfinite(camera.far)) lens["perspective"]["zfar"] = camera.far;
    gltf["cameras"] = Json::array({lens});
    gltf["nodes"].push_back(
        {{"camera", 0}, {"matrix", listOf(glm::value_ptr(camera.world_from_camera), 16)}});
    Json roots = Json::array();
    for (std::size_t i = 0; i < gltf["nodes"].size(); ++i) roots.push_back(i);
    gltf["scenes"] = Json::array({{{"nodes", roots}}});
    std::vector<std::uint8_t> bytes = buffers.close(inside);
    return {std::move(gltf), std::move(bytes)};
}

// Four bytes, the lowest first.
void addWord(std::string& to, std::size_t value) {
    for (unsigned i = 0; i < 4; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
}

// A chunk of a .glb file (glTF 2.0, 4.4.3); `fill`: what makes its length a multiple of 4.
void addChunk(std::string& to, const char* type, std::string data, char fill) {
    data.append((4 - data.size() % 4) % 4, fill);
    addWord(to, data.size());
    to.append(type, 4);
    to += data;
}

}  // namespace

std::string gltfOf(const Case& flat) {
    return writtenScene(flat, true).gltf.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string glbOf(const Case& flat) {
    const Written written = writtenScene(flat, false);
    std::string chunks;
    addChunk(chunks, "JSON", written.gltf.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
    addChunk(chunks, "BIN\0", {written.bytes.begin(), written.bytes.end()}, '\0');
    std::string file = "glTF";
    addWord(file, 2);
    addWord(file, 12 + chunks.size());
    return file + chunks;
}

std::string lightsFileOf(const Case& flat) {
    Json lights = Json::array();
    for (const Light& light : flat.scene.lights) lights.push_back(jsonOf(light));
    return Json{{"lights", lights}}.dump(1) + "\n";
}

}  // namespace diptych::audit
