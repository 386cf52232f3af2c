// SPDX-License-Identifier: MIT
#include "compare/files/gltf_file.h"

#include "shared/scene/gltf/properties.h"
#include "shared/scene/model/material_parts.h"
#include "shared/text/json_text.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace diptych {

using Json = nlohmann::ordered_json;
namespace schema = gltf::schema;

namespace {

// RFC 4648.
std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

// Little-endian, 4 bytes.
void addWord(std::string& to, std::size_t value) {
    for (unsigned i = 0; i < 4; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
}

// A chunk of a .glb file (glTF 2.0, 4.4.3). `fill` pads its length to a multiple of 4.
void addChunk(std::string& to, const char* type, std::string data, char fill) {
    data.append((4 - data.size() % 4) % 4, fill);
    addWord(to, data.size());
    to.append(type, 4);
    to += data;
}

}  // namespace

GltfFile::GltfFile(const std::string& generator)
    : json{{"asset", {{"version", "2.0"}, {"generator", generator}}}} {}

std::size_t GltfFile::addPositions(const std::vector<glm::vec3>& positions) {
    const std::size_t accessor = add(positions, "VEC3", 5126);
    glm::vec3 min = positions.front(), max = min;
    for (const glm::vec3& position : positions) {
        min = glm::min(min, position);
        max = glm::max(max, position);
    }
    json["accessors"][accessor]["min"] = {min.x, min.y, min.z};
    json["accessors"][accessor]["max"] = {max.x, max.y, max.z};
    return accessor;
}

std::size_t GltfFile::addBytes(std::span<const std::byte> bytes) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);  // alignment of float accessors
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return json["bufferViews"].size() - 1;
}

std::size_t GltfFile::addAccessor(std::size_t view, std::size_t count, const char* type, int component) {
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return json["accessors"].size() - 1;
}

std::string GltfFile::text() const {
    Json document = json;
    if (!bytes_.empty())
        document["buffers"] =
            Json::array({{{"byteLength", bytes_.size()},
                          {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}});
    return jsonText(document, 1) + "\n";
}

std::string GltfFile::binary() const {
    Json document = json;
    if (!bytes_.empty()) document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    std::string chunks;
    addChunk(chunks, "JSON", jsonText(document, -1), ' ');
    if (!bytes_.empty())
        addChunk(chunks, "BIN\0", {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}, '\0');
    std::string file = "glTF";
    addWord(file, 2);
    addWord(file, 12 + chunks.size());
    return file + chunks;
}

namespace {

// The factors of an object of the schema. An infinite attenuation distance is the default.
Json factorsOf(const Material& material, std::span<const schema::Property> properties) {
    Json written = Json::object();
    for (const schema::Property& p : properties)
        if (p.part && (*p.part != AnimatedPart::attenuation_distance || material.attenuation_distance > 0))
            written[std::string(p.key)] = gltfFactor(material, *p.part);
    return written;
}

// Adds the extensions whose first factor is a weight, 0 by default, and not 0; in the order of the factors.
void addWeighted(const Material& material, Json& extensions) {
    const auto weighs = [](const Material& m, AnimatedPart part) {
        return std::ranges::any_of(partOf(m, part), [](double value) { return value != 0; });
    };
    std::map<AnimatedPart, const schema::Property*> by_weight;
    for (const schema::Property& extension : schema::materialExtensions)
        if (!extension.properties.empty()) by_weight[*extension.properties.front().part] = &extension;
    for (const auto& [weight, extension] : by_weight)
        if (!weighs({}, weight) && weighs(material, weight))
            extensions[std::string(extension->key)] = factorsOf(material, extension->properties);
}

}  // namespace

Json gltfFactor(const Material& material, AnimatedPart part) {
    const std::vector<double> values = partOf(material, part);
    return values.size() == 1 ? Json(values[0]) : Json(values);
}

Json gltfMaterial(const Material& material) {
    Json written{{"name", material.name}}, extensions = Json::object();
    if (material.specular_glossiness) {
        extensions[specularGlossiness] = factorsOf(material, schema::specularGlossiness);
    } else {
        written["pbrMetallicRoughness"] = factorsOf(material, schema::metallicRoughness);
        extensions["KHR_materials_ior"] = factorsOf(material, schema::ior);
        extensions["KHR_materials_specular"] = factorsOf(material, schema::specular);
    }
    written["doubleSided"] = material.double_sided;
    written["alphaMode"] = material.alpha_mode == AlphaMode::opaque ? "OPAQUE"
                           : material.alpha_mode == AlphaMode::mask ? "MASK"
                                                                    : "BLEND";
    if (material.alpha_mode == AlphaMode::mask) written["alphaCutoff"] = material.alpha_cutoff;
    const float brightest = std::max({material.emissive.r, material.emissive.g, material.emissive.b, 0.0f});
    if (brightest > 0) {
        written["emissiveFactor"] = listOf(glm::dvec3(material.emissive) / double{brightest});
        extensions["KHR_materials_emissive_strength"] = {{"emissiveStrength", brightest}};
    }
    if (material.unlit) extensions["KHR_materials_unlit"] = Json::object();
    addWeighted(material, extensions);
    written["extensions"] = std::move(extensions);
    return written;
}

std::vector<std::string> gltfMaterialExtensions() {
    std::vector<std::string> names;
    for (const schema::Property& extension : schema::materialExtensions) names.emplace_back(extension.key);
    return names;
}

Json gltfCamera(const Camera& camera, double aspect) {
    Json written{{"type", camera.orthographic ? "orthographic" : "perspective"}};
    if (camera.orthographic)
        written["orthographic"] = {{"xmag", camera.ymag * aspect},
                                   {"ymag", camera.ymag},
                                   {"znear", camera.near},
                                   {"zfar", std::isfinite(camera.far) ? camera.far : 1e6 * camera.ymag}};
    else
        written["perspective"] = {{"yfov", camera.yfov}, {"znear", camera.near}};
    if (!camera.orthographic && std::isfinite(camera.far)) written["perspective"]["zfar"] = camera.far;
    return written;
}

Json listOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json listOf(const glm::dmat4& matrix) {
    Json list = Json::array();
    for (int i = 0; i < 16; ++i) list.push_back(glm::value_ptr(matrix)[i]);
    return list;
}

}  // namespace diptych
