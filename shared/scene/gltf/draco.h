// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/value.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

// A primitive with KHR_draco_mesh_compression. Source: Khronos, KHR_draco_mesh_compression, 2018.
struct DracoPrimitive {
    struct Attribute {
        std::string name;  // "POSITION"
        std::uint32_t id;  // its id in the stream
        int accessor;      // gives the number and type of the elements
    };
    std::size_t mesh, primitive;
    int view;  // the bufferView with the stream
    std::vector<Attribute> attributes;
    std::size_t vertices;  // of every attribute
};

// Such primitives of the drawn meshes (`drawn`: one flag for each mesh). A mesh with a primitive that breaks
// a rule of the extension is `broken`, with its first fault.
std::vector<DracoPrimitive> findDraco(const tinygltf::Model& model, const std::vector<bool>& drawn,
                                      std::map<std::size_t, std::string>& broken);

// Bytes that decoding takes: those of its accessors, and what Draco holds for as many triangles.
double dracoCost(const tinygltf::Model& model, const DracoPrimitive& primitive);

// Gives each primitive accessors over decoded bytes; the decoded indices may still name vertices that do not
// exist. A mesh with a stream that cannot be decoded, or would need more than `limit` bytes, is `broken`.
void decodeDraco(tinygltf::Model& model, const std::vector<DracoPrimitive>& primitives, std::size_t limit,
                 std::map<std::size_t, std::string>& broken);

}  // namespace diptych::gltf
