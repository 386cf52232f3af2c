// SPDX-License-Identifier: MIT
#pragma once

#include <draco/mesh/mesh.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace diptych::gltf {

// What a Draco stream is expected to hold, according to the glTF file.
struct DracoExpectation {
    std::size_t vertices;
    std::optional<std::size_t> triangles;  // no value: any number
    std::size_t attributes;                // number of attributes that are read
    std::size_t limit;  // approximate upper bound of the memory that decoding may take, bytes
};

// Memory that Draco holds for each corner of a triangle while it decodes, in bytes: corner table, traversal,
// faces.
constexpr std::size_t dracoBytesPerCorner = 32;

// Decodes a triangle mesh of Draco's bitstream 2.2, the version that the glTF extension names. The library
// trusts a stream's counts; here they are compared with the expectation before memory or time is spent on
// them. The resulting mesh has `vertices` points and `triangles` faces. Throws std::runtime_error: one line
// without a name.
std::unique_ptr<draco::Mesh> decodeDracoStream(std::span<const unsigned char> stream,
                                               const DracoExpectation& expected);

}  // namespace diptych::gltf
