// SPDX-License-Identifier: MIT
// Writes the cells as a glTF file.
#include "shared/image/file_bytes.h"
#include "shared/image/png.h"
#include "shared/scene/gltf/gltf.h"
#include "tests/image/material_cells.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::tests {
namespace {

using Json = nlohmann::json;

std::string pngOf(int index) {
    Image8 image{4, 4, 4, {}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            for (int c = 0; c < 4; ++c)
                image.data.push_back(static_cast<std::uint8_t>(codesAt(index, column, row)[c]));
    const auto file = testFolder() / ("picture" + std::to_string(index) + ".png");
    writePng(file, image);
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Texture n is image n, unfiltered.
void writeImages(GltfFile& file) {
    file.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}}};
    for (int slot = 0; slot < static_cast<int>(cellSlots); ++slot) {
        const std::string png = pngOf(slot);
        file.json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", file.data.size()}, {"byteLength", png.size()}});
        file.data += png;
        file.json["images"].push_back(
            {{"bufferView", file.json["bufferViews"].size() - 1}, {"mimeType", "image/png"}});
        file.json["textures"].push_back({{"source", slot}, {"sampler", 0}});
    }
}

Json pair(const glm::dvec2& v) {
    return {v.x, v.y};
}
Json triple(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json materialOfCell(const Cell& cell) {
    const auto texture = [&](std::size_t slot) {
        const CellTexture& use = cell.textures[slot];
        Json info = {{"index", use.image}, {"texCoord", use.texcoord}};
        if (use.transform) {
            Json& t = info["extensions"]["KHR_texture_transform"];
            t = {{"offset", pair(use.transform->offset)},
                 {"rotation", use.transform->rotation},
                 {"scale", pair(use.transform->scale)}};
            if (use.transform->texcoord) t["texCoord"] = *use.transform->texcoord;
        }
        return info;
    };
    const auto has = [&](std::size_t slot) { return cell.textures[slot].image >= 0; };
    Json m = {{"name", cell.name}, {"emissiveFactor", triple(cell.emissive)}};
    const auto put = [&](Json& where, const char* name, std::size_t slot) {
        if (has(slot)) where[name] = texture(slot);
    };
    const Json color = {cell.base_color.r, cell.base_color.g, cell.base_color.b, cell.base_color.a};
    Json extensions = Json::object();
    if (cell.specular_glossiness) {
        Json& glossy = extensions["KHR_materials_pbrSpecularGlossiness"];
        glossy = {{"diffuseFactor", color},
                  {"specularFactor", triple(cell.specular_color)},
                  {"glossinessFactor", 1 - cell.roughness}};
        put(glossy, "diffuseTexture", gpu::SLOT_base_color);
        put(glossy, "specularGlossinessTexture", gpu::SLOT_specular_color);
    } else {
        Json& pbr = m["pbrMetallicRoughness"];
        pbr = {{"baseColorFactor", color},
               {"metallicFactor", cell.metallic},
               {"roughnessFactor", cell.roughness}};
        put(pbr, "baseColorTexture", gpu::SLOT_base_color);
        put(pbr, "metallicRoughnessTexture", gpu::SLOT_metallic_roughness);
        Json& specular = extensions["KHR_materials_specular"];
        specular = {{"specularFactor", cell.specular}, {"specularColorFactor", triple(cell.specular_color)}};
        put(specular, "specularTexture", gpu::SLOT_specular);
        put(specular, "specularColorTexture", gpu::SLOT_specular_color);
        if (cell.ior) extensions["KHR_materials_ior"]["ior"] = *cell.ior;
    }
    if (has(gpu::SLOT_normal)) {
        m["normalTexture"] = texture(gpu::SLOT_normal);
        m["normalTexture"]["scale"] = cell.normal_scale;
    }
    if (has(gpu::SLOT_occlusion)) {
        m["occlusionTexture"] = texture(gpu::SLOT_occlusion);
        m["occlusionTexture"]["strength"] = cell.occlusion_strength;
    }
    if (has(gpu::SLOT_emissive)) m["emissiveTexture"] = texture(gpu::SLOT_emissive);
    if (cell.emissive_strength)
        extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = *cell.emissive_strength;
    if (cell.unlit) extensions["KHR_materials_unlit"] = Json::object();
    m["extensions"] = extensions;
    if (has(gpu::SLOT_lightmap)) {
        const CellTexture& use = cell.textures[gpu::SLOT_lightmap];
        m["extras"]["diptych"]["lightmap"] = {
            {"index", use.image}, {"texCoord", use.texcoord}, {"intensity", cell.lightmap_intensity}};
    }
    if (cell.masked) m["alphaMode"] = "MASK";
    if (cell.alpha_cutoff) m["alphaCutoff"] = *cell.alpha_cutoff;
    if (cell.double_sided) m["doubleSided"] = true;
    return m;
}

// The upper left, lower left, lower right and upper right vertices.
void writeSquare(GltfFile& file, const Cell& cell, std::size_t material) {
    const glm::vec2 half(0.5 / std::abs(cell.scale.x), 0.5 / std::abs(cell.scale.y));
    const auto tx = static_cast<float>(std::cos(cell.tangent_angle)),
               ty = static_cast<float>(std::sin(cell.tangent_angle)), w = static_cast<float>(cell.tangent_w);
    std::vector<float> positions, normals, tangents, first, second, colors;
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
        positions.insert(positions.end(), {(2 * at.x - 1) * half.x, (1 - 2 * at.y) * half.y, 0});
        normals.insert(normals.end(), {0, 0, 1});
        tangents.insert(tangents.end(), {tx, ty, 0, w});
        first.insert(first.end(), {at.x, at.y});
        second.insert(second.end(), {at.y, at.x});
    }
    Json attributes = {{"POSITION", file.accessor(positions, FLOAT, "VEC3", 3)},
                       {"NORMAL", file.accessor(normals, FLOAT, "VEC3", 3)},
                       {"TEXCOORD_0", file.accessor(first, FLOAT, "VEC2", 2)},
                       {"TEXCOORD_1", file.accessor(second, FLOAT, "VEC2", 2)}};
    if (!cell.tangents_made) attributes["TANGENT"] = file.accessor(tangents, FLOAT, "VEC4", 4);
    const auto color = [&]<class T>(double max, int type, int width, T) {
        std::vector<T> values;
        for (int corner = 0; corner < 4; ++corner)
            for (int c = 0; c < width; ++c)
                values.push_back(static_cast<T>(cell.color[c] * max + (max > 1 ? 0.5 : 0)));
        attributes["COLOR_0"] = file.accessor(values, type, width == 4 ? "VEC4" : "VEC3",
                                              static_cast<std::size_t>(width), type != FLOAT);
    };
    switch (cell.colors) {
        case CellColors::none:
            break;
        case CellColors::floats:
            color(1, FLOAT, 4, float{});
            break;
        case CellColors::rgb:
            color(1, FLOAT, 3, float{});
            break;
        case CellColors::bytes:
            color(255, UBYTE, 4, std::uint8_t{});
            break;
        case CellColors::shorts:
            color(65535, USHORT, 4, std::uint16_t{});
            break;
    }
    const int indices = file.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, USHORT, "SCALAR", 1);
    file.json["meshes"].push_back(
        {{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", material}}}}});
    const auto column = static_cast<double>(material % cellsAcross),
               row = static_cast<double>(material / cellsAcross);
    file.json["nodes"].push_back(
        {{"mesh", material},
         {"translation", {column + 0.5 - cellsAcross / 2, cellsAcross / 2 - 0.5 - row, 0}},
         {"scale", triple(cell.scale)},
         {"rotation", cell.turned ? Json{0, 1, 0, 0} : Json{0, 0, 0, 1}}});
}

int addNode(GltfFile& file, Json node) {
    file.json["nodes"].push_back(std::move(node));
    return static_cast<int>(file.json["nodes"].size()) - 1;
}

// Every camera frames a square that fills the shorter side of its image.
void writeCamera(GltfFile& file, const CellCamera& camera) {
    const double half = camera.half * std::min(1.0, static_cast<double>(camera.size.x) / camera.size.y),
                 far = 1000;
    if (camera.orthographic)
        file.json["cameras"].push_back(
            {{"name", camera.name},
             {"type", "orthographic"},
             {"orthographic", {{"xmag", half}, {"ymag", half}, {"znear", 0.5}, {"zfar", far}}}});
    else
        file.json["cameras"].push_back({{"name", camera.name},
                                        {"type", "perspective"},
                                        {"perspective",
                                         {{"yfov", 2 * std::atan(half / camera.eye.z)},
                                          {"aspectRatio", 1},
                                          {"znear", 0.5},
                                          {"zfar", far}}}});
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3& eye = camera.eye;
    addNode(file, {{"camera", file.json["cameras"].size() - 1},
                   {"matrix",
                    {axes[0].x, axes[0].y, axes[0].z, 0, axes[1].x, axes[1].y, axes[1].z, 0, axes[2].x,
                     axes[2].y, axes[2].z, 0, eye.x, eye.y, eye.z, 1}}});
}

}  // namespace

Scene materialScene(const std::vector<Cell>& cells) {
    GltfFile file;
    file.json["nodes"] = Json::array();
    file.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength",
                                   "KHR_materials_ior",     "KHR_materials_specular",
                                   "KHR_materials_unlit",   "KHR_materials_pbrSpecularGlossiness",
                                   "KHR_lights_punctual"};
    writeImages(file);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        file.json["materials"].push_back(materialOfCell(cells[i]));
        writeSquare(file, cells[i], i);
    }
    for (const CellCamera& camera : cellCameras()) writeCamera(file, camera);
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 2}, {"color", {1, 0.8, 0.6}}},
        {{"type", "point"}, {"intensity", 30}, {"color", {0.5, 0.7, 1}}}};
    // The sun shines along -Z of its node, rotated about X by 0.9 rad: from above the viewer.
    addNode(file, {{"rotation", {-std::sin(0.45), 0, 0, std::cos(0.45)}},
                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    addNode(file,
            {{"translation", {-1.5, 0.7, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    Json roots = Json::array();
    for (std::size_t i = 0; i < file.json["nodes"].size(); ++i) roots.push_back(i);
    file.json["scenes"] = {{{"nodes", roots}}};
    const std::string bytes = file.binary();
    return parseGltf({bytes.begin(), bytes.end()}, "materials.glb");
}

}  // namespace diptych::tests
