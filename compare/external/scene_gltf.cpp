// SPDX-License-Identifier: MIT
#include "compare/external/scene_gltf.h"

#include "compare/files/gltf_file.h"
#include "shared/image/png.h"
#include "shared/scene/gltf/properties.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/model/axes.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/motion/posed.h"
#include "shared/text/counted.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace diptych::external {
namespace {

using Json = nlohmann::ordered_json;
namespace schema = gltf::schema;

constexpr int float_component = 5126, index_component = 5125;

// Counts omissions: one line per kind.
class LeftOut {
public:
    void add(const std::string& what, const std::string& why) { ++counts_[{what, why}]; }
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const auto& [what, count] : counts_) lines.push_back(counted(count, what.first) + what.second);
        return lines;
    }

private:
    std::map<std::pair<std::string, std::string>, std::size_t> counts_;  // key: noun, reason
};

std::vector<glm::vec3> inFloat(const std::vector<glm::dvec3>& values) {
    std::vector<glm::vec3> out;
    for (const glm::dvec3& value : values) out.emplace_back(value);
    return out;
}

// Node transform whose -Z axis is `direction`.
glm::dmat4 shining(const glm::dvec3& position, const glm::dvec3& direction) {
    const glm::dvec3 back = -unitOr(direction, {0, 0, -1}), right = perpendicularTo(back);
    glm::dmat4 world(1.0);
    world[0] = glm::dvec4(right, 0);
    world[1] = glm::dvec4(glm::cross(back, right), 0);
    world[2] = glm::dvec4(back, 0);
    world[3] = glm::dvec4(position, 1);
    return world;
}

class SceneWriter {
public:
    SceneWriter() : file_("diptych") {
        for (const char* list : {"nodes", "meshes", "materials"}) file_.json[list] = Json::array();
    }

    void addLights(const std::vector<Light>& lights) {
        Json written = Json::array();
        for (const Light& light : lights) {
            if (isArea(light.kind)) {
                left_out_.add(fmt::format("{} light", nameOf(light.kind)), ": glTF has no such lights");
                continue;
            }
            Json one{{"type", nameOf(light.kind)},
                     {"color", listOf(glm::dvec3(light.color))},
                     {"intensity", light.intensity}};
            if (!light.name.empty()) one["name"] = light.name;
            if (std::isfinite(light.range) && light.kind != LightKind::directional)
                one["range"] = light.range;
            if (light.kind == LightKind::spot)
                one["spot"] = {{"innerConeAngle", light.inner_cone}, {"outerConeAngle", light.outer_cone}};
            addNode({{"matrix", listOf(shining(light.position, light.direction))},
                     {"extensions", {{"KHR_lights_punctual", {{"light", written.size()}}}}}});
            written.push_back(std::move(one));
        }
        if (written.empty()) return;
        extensions_.insert("KHR_lights_punctual");
        file_.json["extensions"]["KHR_lights_punctual"] = {{"lights", std::move(written)}};
    }

    void addCamera(const View& view) {
        file_.json["cameras"] =
            Json::array({gltfCamera(view.camera, static_cast<double>(view.width) / view.height)});
        glm::dmat4 world(1.0);
        world[0] = glm::dvec4(view.right(), 0);
        world[1] = glm::dvec4(view.up(), 0);
        world[2] = glm::dvec4(view.backward(), 0);
        world[3] = glm::dvec4(view.eye(), 1);
        addNode({{"camera", 0}, {"matrix", listOf(world)}});
    }

    void addScene(const Scene& scene, const Pose& pose, SkinNormals normals) {
        const std::vector<Material>& materials = materialsOf(scene, pose);
        for (const Material& material : materials) addMaterial(scene, material);
        if (!materials.empty())
            for (const std::string& extension : gltfMaterialExtensions()) extensions_.insert(extension);
        // Without the extension, such a material would be drawn as if the file had none.
        if (std::ranges::any_of(materials, &Material::specular_glossiness))
            file_.json["extensionsRequired"] = Json::array({specularGlossiness});
        for (const Instance& instance : pose.instances) addInstance(scene, pose, instance, normals);
    }

    WrittenScene finish() {
        Json roots = Json::array();
        for (std::size_t i = 0; i < file_.json["nodes"].size(); ++i) roots.push_back(i);
        file_.json["scene"] = 0;
        file_.json["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
        // glTF forbids empty arrays.
        for (const char* list : {"nodes", "meshes", "materials"})
            if (file_.json[list].empty()) file_.json.erase(list);
        if (file_.json["scenes"][0]["nodes"].empty()) file_.json["scenes"][0].erase("nodes");
        if (!extensions_.empty()) file_.json["extensionsUsed"] = extensions_;
        return {file_.binary(), left_out_.lines()};
    }

private:
    void addNode(Json node) { file_.json["nodes"].push_back(std::move(node)); }

    void addInstance(const Scene& scene, const Pose& pose, const Instance& instance, SkinNormals normals) {
        const Primitive& primitive = primitiveOf(scene, instance);
        if (primitive.indices.empty() || primitive.positions.empty()) return;
        if (instance.deformed()) {
            Primitive posed = posedPrimitive(scene, pose, instance, normals);
            const double scale = volumeScale(scene, pose, instance);
            for (glm::vec3& position : posed.positions) position /= static_cast<float>(scale);
            return addNode({{"mesh", addMesh(posed)}, {"scale", {scale, scale, scale}}});
        }
        const auto [found, added] = meshes_.try_emplace({instance.mesh, instance.primitive}, 0);
        if (added) found->second = addMesh(primitive);
        addNode({{"mesh", found->second}, {"matrix", listOf(instance.world_from_object)}});
    }

    // Scale of the node of a posed mesh: 1, or that by which the original's nodes scale a volume's thickness.
    static double volumeScale(const Scene& scene, const Pose& pose, const Instance& instance) {
        const auto material = static_cast<std::size_t>(primitiveOf(scene, instance).material);
        const bool thick = materialsOf(scene, pose)[material].thickness > 0;
        const double scale = thick ? lengthScale(instance) : 1;
        return scale > 0 ? scale : 1;
    }

    // Vertices in world space.
    static Primitive posedPrimitive(const Scene& scene, const Pose& pose, const Instance& instance,
                                    SkinNormals normals) {
        Primitive posed = primitiveOf(scene, instance);
        const PosedVertices vertices = posedVertices(scene, pose, instance, normals == SkinNormals::blended);
        posed.positions = inFloat(vertices.positions);
        posed.normals = inFloat(vertices.normals);
        // Applies the transform's handedness to winding and bitangents.
        const bool mirrored = glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
        for (std::size_t i = 0; i < posed.tangents.size(); ++i)
            posed.tangents[i] = glm::vec4(
                glm::vec3(vertices.tangents[i]),
                posed.tangents[i].w * static_cast<float>(vertices.bitangents) * (mirrored ? -1.f : 1.f));
        for (int set = 0; set < 2; ++set)
            if (!vertices.texcoords[set].empty())
                posed.texcoords[set].assign(vertices.texcoords[set].begin(), vertices.texcoords[set].end());
        if (!vertices.colors.empty()) posed.colors.assign(vertices.colors.begin(), vertices.colors.end());
        for (std::size_t i = 0; mirrored && i + 2 < posed.indices.size(); i += 3)
            std::swap(posed.indices[i + 1], posed.indices[i + 2]);
        return posed;
    }

    std::size_t addMesh(const Primitive& primitive) {
        Json attributes{{"POSITION", file_.addPositions(primitive.positions)},
                        {"NORMAL", file_.add(primitive.normals, "VEC3", float_component)}};
        // A file has one frame for all maps; without it renderers make each map's own.
        const auto isShared = [](const glm::vec4& tangent) { return std::abs(tangent.w) == 1; };
        if (std::ranges::all_of(primitive.tangents, isShared))
            attributes["TANGENT"] = file_.add(primitive.tangents, "VEC4", float_component);
        for (int set = 0; set < 2; ++set)
            if (!primitive.texcoords[set].empty())
                attributes[fmt::format("TEXCOORD_{}", set)] =
                    file_.add(primitive.texcoords[set], "VEC2", float_component);
        if (!primitive.colors.empty())
            attributes["COLOR_0"] = file_.add(primitive.colors, "VEC4", float_component);
        file_.json["meshes"].push_back(
            {{"primitives",
              Json::array({{{"attributes", std::move(attributes)},
                            {"indices", file_.add(primitive.indices, "SCALAR", index_component)},
                            {"material", primitive.material}}})}});
        return file_.json["meshes"].size() - 1;
    }

    void addMaterial(const Scene& scene, const Material& material) {
        Json written = gltfMaterial(material);
        for (const schema::Property& p : schema::material) putTexture(written, p, scene, material);
        // The rest in the order of slots.
        for (std::size_t slot = 0; slot < gpu::SLOT_COUNT; ++slot) {
            const auto put = [&](Json& objects, const schema::Property& object) {
                for (const schema::Property& p : object.properties)
                    if (p.slot == slot && objects.contains(object.key))
                        putTexture(objects[std::string(object.key)], p, scene, material);
            };
            for (const schema::Property& object : schema::material) put(written, object);
            for (const schema::Property& extension : schema::materialExtensions)
                put(written["extensions"], extension);
        }
        if (readsSlot(material, gpu::SLOT_lightmap)) left_out_.add("lightmap", ": glTF has no lightmaps");
        file_.json["materials"].push_back(std::move(written));
    }

    // Adds the texture of a property, if it has one and the material reads it, with its scale or strength.
    void putTexture(Json& where, const schema::Property& p, const Scene& scene, const Material& material) {
        if (p.slot == gpu::SLOT_COUNT || !readsSlot(material, p.slot)) return;
        std::optional<Json> reference = textureOf(scene, material.*materialSlots[p.slot].texture);
        if (!reference) return;
        for (const schema::Property& own : p.properties)
            if (own.part) (*reference)[std::string(own.key)] = gltfFactor(material, *own.part);
        where[std::string(p.key)] = std::move(*reference);
    }

    // Empty if the image cannot be written.
    std::optional<Json> textureOf(const Scene& scene, const TextureSlot& slot) {
        const Texture& texture = scene.textures[static_cast<std::size_t>(slot.texture)];
        const TextureImage& image = scene.images[static_cast<std::size_t>(texture.image)];
        if (!image.rgba32.empty()) {
            left_out_.add("float texture", ": glTF has no float textures");
            return {};
        }
        Json reference{{"index", textureIndex(texture, image)}, {"texCoord", slot.texcoord}};
        if (isTransformed(slot)) {
            // slot.u = (c sx, s sy), slot.v = (-s sx, c sy).
            const double across = std::hypot(slot.u.x, slot.v.x), rotation = std::atan2(-slot.v.x, slot.u.x);
            const double along = std::cos(rotation) * slot.v.y + std::sin(rotation) * slot.u.y;
            extensions_.insert("KHR_texture_transform");
            reference["extensions"]["KHR_texture_transform"] = {
                {"offset", {slot.u.z, slot.v.z}}, {"rotation", rotation}, {"scale", {across, along}}};
        }
        return reference;
    }

    std::size_t textureIndex(const Texture& texture, const TextureImage& image) {
        const auto same = std::ranges::find_if(textures_, [&](const auto& known) {
            return known.first.image == texture.image && known.first.sampler == texture.sampler;
        });
        if (same != textures_.end()) return same->second;
        const auto [found, added] = images_.try_emplace(texture.image, 0);
        if (added) found->second = addImage(image);
        const Sampler& s = texture.sampler;
        const auto wrap = [](Wrap how) {
            return how == Wrap::repeat ? 10497 : how == Wrap::mirrored_repeat ? 33648 : 33071;
        };
        const int nearest = 9728;  // GL constants: + 1 is linear; 9984 and up with mip levels
        const int minify =
            !s.mipmaps ? nearest + s.minify_linear : 9984 + s.minify_linear + 2 * s.mipmaps_linear;
        file_.json["samplers"].push_back({{"magFilter", nearest + s.magnify_linear},
                                          {"minFilter", minify},
                                          {"wrapS", wrap(s.wrap_s)},
                                          {"wrapT", wrap(s.wrap_t)}});
        file_.json["textures"].push_back(
            {{"sampler", file_.json["samplers"].size() - 1}, {"source", found->second}});
        textures_.emplace_back(texture, file_.json["textures"].size() - 1);
        return textures_.back().second;
    }

    std::size_t addImage(const TextureImage& image) {
        Image8 png{image.width, image.height, 4, image.rgba};
        if (png.data.empty()) {
            left_out_.add("16-bit texture", ": written with 8 bits");
            for (const std::uint16_t value : image.rgba16)
                png.data.push_back(static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u));
        }
        const std::string bytes = pngBytes(png);
        file_.json["images"].push_back(
            {{"mimeType", "image/png"}, {"bufferView", file_.addBytes(std::as_bytes(std::span(bytes)))}});
        return file_.json["images"].size() - 1;
    }

    GltfFile file_;
    LeftOut left_out_;
    std::set<std::string> extensions_;
    std::map<std::pair<int, int>, std::size_t> meshes_;  // key: mesh, primitive
    std::map<int, std::size_t> images_;                  // key: index in Scene::images
    std::vector<std::pair<Texture, std::size_t>> textures_;
};

}  // namespace

WrittenScene sceneGltf(const Scene& scene, const SceneView& view, SkinNormals normals) {
    SceneWriter writer;
    writer.addCamera(view.view);
    writer.addScene(scene, view.pose, normals);
    writer.addLights(view.lights);
    return writer.finish();
}

WrittenScene rigGltf(const SceneView& view) {
    SceneWriter writer;
    writer.addCamera(view.view);
    writer.addLights(view.lights);
    return writer.finish();
}

}  // namespace diptych::external
