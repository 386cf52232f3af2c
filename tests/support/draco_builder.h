// SPDX-License-Identifier: MIT
// glTF files with KHR_draco_mesh_compression, built with Draco's own encoder.
#pragma once

#include "tests/support/gltf_builder.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <array>
#include <memory>

namespace diptych {

// Encoder settings. bits: quantization of positions, normals and texture coordinates; 0 is lossless.
struct DracoWay {
    int method = draco::MESH_EDGEBREAKER_ENCODING;
    int speed = 5;
    int bits = 0;
    bool metadata = false;
};

struct DracoStream {
    std::string bytes;
    std::size_t vertices, triangles;
};

// Attributes are functions of the position: a vertex can be checked wherever the encoder puts it.
inline glm::vec2 texcoordAt(const glm::vec3& p) {
    return {p.x / 4, p.y / 8};
}
inline glm::u8vec4 colorAt(const glm::vec3& p) {
    return {static_cast<int>(p.x) * 10, static_cast<int>(p.y) * 10, 51, 255};
}
inline glm::u8vec2 countsAt(const glm::vec3& p) {
    return {static_cast<int>(p.x), static_cast<int>(p.y)};
}

inline std::vector<std::array<glm::vec3, 3>> trianglesOf(int n) {
    std::vector<std::array<glm::vec3, 3>> result;
    const auto at = [](int x, int y) { return glm::vec3(x, y, (3 * x + y) % 4); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            result.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
            result.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    return result;
}

// n x n squares. Unique ids: 0 POSITION, 1 NORMAL, 2 TEX_COORD, 3 COLOR, 4 integers.
inline DracoStream encoded(int n, const DracoWay& way = {}) {
    const auto triangles = trianglesOf(n);
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(triangles.size()));
    builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    builder.AddAttribute(draco::GeometryAttribute::GENERIC, 2, draco::DT_UINT8);
    const glm::vec3 up(0, 0, 1);
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
        const auto set = [&](int attribute, const auto& value) {
            const auto& t = triangles[f];
            const auto a = value(t[0]), b = value(t[1]), c = value(t[2]);
            builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(f), &a, &b, &c);
        };
        set(0, [](const glm::vec3& p) { return p; });
        set(1, [&](const glm::vec3&) { return up; });
        set(2, texcoordAt);
        set(3, colorAt);
        set(4, countsAt);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    if (way.metadata) {
        auto metadata = std::make_unique<draco::GeometryMetadata>();
        metadata->AddEntryString("name", "surface");
        auto inner = std::make_unique<draco::Metadata>();
        inner->AddEntryInt("level", 1);
        metadata->AddSubMetadata("inner", std::move(inner));
        mesh->AddMetadata(std::move(metadata));
        auto texcoords = std::make_unique<draco::AttributeMetadata>();
        texcoords->AddEntryString("name", "uv");
        mesh->AddAttributeMetadata(2, std::move(texcoords));
    }
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(way.method);
    encoder.SetSpeedOptions(way.speed, way.speed);
    encoder.SetTrackEncodedProperties(true);
    if (way.bits)
        for (const int attribute : {0, 1, 2}) encoder.SetAttributeQuantization(attribute, way.bits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {{buffer.data(), buffer.size()}, encoder.num_encoded_points(), encoder.num_encoded_faces()};
}

// Accessors without data, as the extension requires.
inline int declared(GltfFile& f, std::size_t count, int componentType, const char* type,
                    bool normalized = false) {
    f.json["accessors"].push_back(
        {{"componentType", componentType}, {"count", count}, {"type", type}, {"normalized", normalized}});
    return static_cast<int>(f.json["accessors"].size()) - 1;
}

inline int viewOf(GltfFile& f, const std::string& bytes) {
    f.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", f.data.size()}, {"byteLength", bytes.size()}});
    f.data += bytes;
    return static_cast<int>(f.json["bufferViews"].size()) - 1;
}

inline nlohmann::json& extensionOf(GltfFile& f) {
    return f.primitive()["extensions"]["KHR_draco_mesh_compression"];
}

// Accessors: 0 POSITION, 1 NORMAL, 2 TEXCOORD_0, 3 COLOR_0, 4 TEXCOORD_1 (integers), 5 indices.
inline GltfFile compressed(const DracoStream& s) {
    GltfFile f;
    f.json["nodes"] = {{{"mesh", 0}}};
    nlohmann::json attributes = {{"POSITION", declared(f, s.vertices, FLOAT, "VEC3")}};
    attributes["NORMAL"] = declared(f, s.vertices, FLOAT, "VEC3");
    attributes["TEXCOORD_0"] = declared(f, s.vertices, FLOAT, "VEC2");
    attributes["COLOR_0"] = declared(f, s.vertices, UBYTE, "VEC4", true);
    attributes["TEXCOORD_1"] = declared(f, s.vertices, USHORT, "VEC2");
    f.json["meshes"] = {{{"primitives", {{{"attributes", attributes}}}}}};
    f.primitive()["indices"] = declared(f, 3 * s.triangles, USHORT, "SCALAR");
    extensionOf(f) = {
        {"bufferView", viewOf(f, s.bytes)},
        {"attributes",
         {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}, {"TEXCOORD_1", 4}}}};
    f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return f;
}

}  // namespace diptych
