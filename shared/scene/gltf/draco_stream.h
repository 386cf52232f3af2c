// SPDX-License-Identifier: MIT
#pragma once

#include <draco/mesh/mesh.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace diptych::gltf {

// Expected contents of a Draco stream, according to the glTF file.
struct DracoExpectation {
    std::size_t vertices;
    std::optional<std::size_t> triangles;  // nullopt: any number
    std::size_t attributes;                // attributes that are read
    std::size_t limit;                     // approximate bound of the decoder's memory, bytes
};

// Memory that Draco needs per triangle corner during decoding, bytes: corner table, traversal, faces.
constexpr std::size_t dracoBytesPerCorner = 32;

// Decodes a triangle mesh of Draco bitstream 2.2, the version that the glTF extension names. The library
// trusts the stream's counts, so they are checked against `expected` before memory or time is spent. The
// mesh has `vertices` points and `triangles` faces. Throws std::runtime_error: one line without a name.
std::unique_ptr<draco::Mesh> decodeDracoStream(std::span<const unsigned char> stream,
                                               const DracoExpectation& expected);

}  // namespace diptych::gltf
