// SPDX-License-Identifier: MIT
#include "compare/files/gltf_file.h"
#include "shared/text/json_text.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych {

using Json = nlohmann::ordered_json;

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
    glm::vec3 least = positions.front(), most = least;
    for (const glm::vec3& position : positions) {
        least = glm::min(least, position);
        most = glm::max(most, position);
    }
    json["accessors"][accessor]["min"] = {least.x, least.y, least.z};
    json["accessors"][accessor]["max"] = {most.x, most.y, most.z};
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

// Base colour, metal or F0, and roughness, in the core model or in the extension that replaces it.
void addReflection(const Material& material, Json& written, Json& extensions) {
    const glm::vec4& color = material.base_color;
    const Json base{color.r, color.g, color.b, color.a},
        specular = listOf(glm::dvec3(material.specular_color));
    if (material.specular_glossiness) {
        extensions[specularGlossiness] = {{"diffuseFactor", base},
                                          {"specularFactor", specular},
                                          {"glossinessFactor", 1 - double{material.roughness}}};
        return;
    }
    written["pbrMetallicRoughness"] = {{"baseColorFactor", base},
                                       {"metallicFactor", material.metallic},
                                       {"roughnessFactor", material.roughness}};
    extensions["KHR_materials_ior"] = {{"ior", material.ior}};
    extensions["KHR_materials_specular"] = {{"specularFactor", material.specular},
                                            {"specularColorFactor", specular}};
}

void addVolume(const Material& material, Json& extensions) {
    if (material.thickness > 0) {
        Json& volume = extensions["KHR_materials_volume"];
        volume = {{"thicknessFactor", material.thickness},
                  {"attenuationColor", listOf(glm::dvec3(material.attenuation_color))}};
        if (material.attenuation_distance > 0) volume["attenuationDistance"] = material.attenuation_distance;
    }
    if (material.dispersion > 0)
        extensions["KHR_materials_dispersion"] = {{"dispersion", material.dispersion}};
    if (material.diffuse_transmission > 0)
        extensions["KHR_materials_diffuse_transmission"] = {
            {"diffuseTransmissionFactor", material.diffuse_transmission},
            {"diffuseTransmissionColorFactor", listOf(glm::dvec3(material.diffuse_transmission_color))}};
}

}  // namespace

Json gltfMaterial(const Material& material) {
    Json written{{"name", material.name}}, extensions = Json::object();
    addReflection(material, written, extensions);
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
    if (material.transmission > 0)
        extensions["KHR_materials_transmission"] = {{"transmissionFactor", material.transmission}};
    addVolume(material, extensions);
    if (material.clearcoat > 0)
        extensions["KHR_materials_clearcoat"] = {{"clearcoatFactor", material.clearcoat},
                                                 {"clearcoatRoughnessFactor", material.clearcoat_roughness}};
    if (material.anisotropy > 0)
        extensions["KHR_materials_anisotropy"] = {{"anisotropyStrength", material.anisotropy},
                                                  {"anisotropyRotation", material.anisotropy_rotation}};
    if (material.sheen_color != glm::vec3(0))
        extensions["KHR_materials_sheen"] = {{"sheenColorFactor", listOf(glm::dvec3(material.sheen_color))},
                                             {"sheenRoughnessFactor", material.sheen_roughness}};
    if (material.iridescence > 0)
        extensions["KHR_materials_iridescence"] = {
            {"iridescenceFactor", material.iridescence},
            {"iridescenceIor", material.iridescence_ior},
            {"iridescenceThicknessMinimum", material.iridescence_thickness_least},
            {"iridescenceThicknessMaximum", material.iridescence_thickness_most}};
    written["extensions"] = std::move(extensions);
    return written;
}

std::vector<std::string> gltfMaterialExtensions() {
    return {"KHR_materials_ior",
            "KHR_materials_specular",
            specularGlossiness,
            "KHR_materials_emissive_strength",
            "KHR_materials_unlit",
            "KHR_materials_transmission",
            "KHR_materials_clearcoat",
            "KHR_materials_anisotropy",
            "KHR_materials_sheen",
            "KHR_materials_iridescence",
            "KHR_materials_volume",
            "KHR_materials_dispersion",
            "KHR_materials_diffuse_transmission"};
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
