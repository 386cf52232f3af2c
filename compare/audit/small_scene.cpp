// SPDX-License-Identifier: MIT
#include "compare/audit/small_scene.h"

#include "compare/files/gltf_file.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"
#include "shared/scene/motion/pose.h"
#include "shared/text/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace diptych::audit {

using Json = nlohmann::ordered_json;

std::optional<Case> flattened(const Case& whole) {
    const Pose pose = poseAt(whole.scene, whole.settings.time, whole.settings.animation);
    Case flat;
    flat.settings = whole.settings;
    flat.exposure = whole.exposure;
    flat.settings.time = 0;
    flat.settings.animation.clear();
    flat.settings.variant.clear();
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
        for (const MaterialSlot& slot : materialSlots) material.*slot.texture = {};
    for (const Instance& instance : pose.instances) {
        if (instance.deformed()) return {};
        Primitive primitive = primitiveOf(whole.scene, instance);
        primitive.texcoords[0].clear();
        primitive.texcoords[1].clear();
        // Anisotropy's own tangents: it has no texture any more.
        const Material& textured =
            materialsOf(whole.scene, pose)[static_cast<std::size_t>(primitive.material)];
        const bool rotated = (rotatedMaps(textured, true).layers & gpu::LAYER_ANISOTROPY) != 0;
        for (std::size_t v = 0; v < primitive.tangents.size(); ++v) {
            glm::vec4& tangent = primitive.tangents[v];
            tangent = rotated ? rotatedTangent(primitive.normals[v], tangent)
                              : glm::vec4(glm::vec3(tangent), signOf(tangent.w));
        }
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

bool isRigid(const Primitive& primitive) {
    return primitive.joint_sets.empty() && primitive.targets.empty();
}

Primitive withoutVertices(const Primitive& primitive) {
    Primitive empty;
    empty.material = primitive.material;
    empty.flat = primitive.flat;
    return empty;
}

void addVertex(Primitive& to, const Primitive& from, std::uint32_t i) {
    to.indices.push_back(static_cast<std::uint32_t>(to.positions.size()));
    eachAttribute(to, from, [i](auto& values, const auto& original) { values.push_back(original[i]); });
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

GltfFile writtenScene(const Case& flat) {
    GltfFile file("diptych audit");
    Json& gltf = file.json;
    gltf["extensionsUsed"] = gltfMaterialExtensions();
    gltf["scene"] = 0;
    for (const char* key : {"materials", "meshes", "nodes"}) gltf[key] = Json::array();
    const std::vector<int> materials = writtenMaterials(flat.scene);
    for (const int material : materials)
        gltf["materials"].push_back(gltfMaterial(flat.scene.materials[static_cast<std::size_t>(material)]));
    for (const Node& node : flat.scene.nodes) {
        const Primitive& primitive =
            flat.scene.meshes[static_cast<std::size_t>(node.mesh)].primitives.front();
        if (primitive.indices.empty()) continue;
        const auto material = std::ranges::find(materials, primitive.material) - materials.begin();
        Primitive used;
        for (const std::uint32_t i : primitive.indices) addVertex(used, primitive, i);
        Json attributes{{"POSITION", file.addPositions(used.positions)},
                        {"NORMAL", file.add(used.normals, "VEC3", 5126)}};
        if (flat.scene.materials[static_cast<std::size_t>(primitive.material)].anisotropy > 0)
            attributes["TANGENT"] = file.add(used.tangents, "VEC4", 5126);
        if (!used.colors.empty()) attributes["COLOR_0"] = file.add(used.colors, "VEC4", 5126);
        gltf["meshes"].push_back(
            {{"primitives", Json::array({{{"attributes", attributes},
                                          {"indices", file.add(used.indices, "SCALAR", 5125)},
                                          {"material", material}}})}});
        gltf["nodes"].push_back(
            {{"mesh", gltf["meshes"].size() - 1}, {"matrix", listOf(node.parent_from_node)}});
    }
    const double aspect = static_cast<double>(flat.settings.size.width) / flat.settings.size.height;
    gltf["cameras"] = Json::array({gltfCamera(flat.camera(), aspect)});
    gltf["nodes"].push_back({{"camera", 0}, {"matrix", listOf(flat.camera().world_from_camera)}});
    Json roots = Json::array();
    for (std::size_t i = 0; i < gltf["nodes"].size(); ++i) roots.push_back(i);
    gltf["scenes"] = Json::array({{{"nodes", roots}}});
    return file;
}

}  // namespace

std::string gltfOf(const Case& flat) {
    return writtenScene(flat).text();
}
std::string glbOf(const Case& flat) {
    return writtenScene(flat).binary();
}

std::string lightsFileOf(const Case& flat) {
    Json lights = Json::array();
    for (const Light& light : flat.scene.lights) lights.push_back(jsonOf(light));
    return jsonText(Json{{"lights", lights}}, 1) + "\n";
}

}  // namespace diptych::audit
