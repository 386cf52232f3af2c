// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;

// A primitive with KHR_draco_mesh_compression. Source: Khronos, KHR_draco_mesh_compression, 2018.
struct DracoPrimitive {
    struct Attribute {
        std::string name;  // "POSITION"
        std::uint32_t id;  // its id in the stream
        int accessor;      // gives count and type of the elements
    };
    std::size_t mesh, primitive;
    int view;  // bufferView of the stream
    std::vector<Attribute> attributes;
    std::size_t vertices;  // per attribute
};

// Finds the Draco primitives of the drawn meshes (`drawn`: one flag per mesh). A mesh with a primitive
// that violates the extension becomes `broken`, with its first fault.
std::vector<DracoPrimitive> findDraco(const Model& model, const std::vector<bool>& drawn,
                                      std::map<std::size_t, std::string>& broken);

// Memory that decoding needs, bytes: the accessors, plus Draco's own data per triangle.
double dracoCost(const Model& model, const DracoPrimitive& primitive);

// Gives each primitive accessors of decoded elements. Decoded indices are not yet checked against the vertex
// count. A mesh becomes `broken` if a stream cannot be decoded or would need more than `limit` bytes.
void decodeDraco(Model& model, const std::vector<DracoPrimitive>& primitives, std::size_t limit,
                 std::map<std::size_t, std::string>& broken);

}  // namespace diptych::gltf
