// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/value.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych::gltf {

// A primitive of KHR_draco_mesh_compression. Source: Khronos, KHR_draco_mesh_compression, 2018.
struct DracoPrimitive {
    struct Attribute {
        std::string name;  // "POSITION"
        std::uint32_t id;  // in the stream
        int accessor;      // says how many elements of which type
    };
    std::size_t mesh, primitive;
    int view;  // the bufferView that holds the stream
    std::vector<Attribute> attributes;
    std::size_t vertices;  // of every one of them
};

// Of those meshes that are drawn, one flag each. Throws std::runtime_error at the first that breaks a rule of
// the extension.
std::vector<DracoPrimitive> findDraco(const tinygltf::Model& model, const std::vector<bool>& drawn);

// Bytes that its accessors ask for, and what Draco needs for as many triangles.
double dracoCost(const tinygltf::Model& model, const DracoPrimitive& primitive);

// Gives every one of them accessors over decoded bytes; triangles may still name vertices that are not there.
// A stream that would need more than `limit` bytes is refused.
void decodeDraco(tinygltf::Model& model, const std::vector<DracoPrimitive>& primitives, std::size_t limit);

}  // namespace diptych::gltf
