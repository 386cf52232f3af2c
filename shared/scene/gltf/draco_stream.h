// SPDX-License-Identifier: MIT
#pragma once

#include <draco/mesh/mesh.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace diptych::gltf {

// What a Draco stream is expected to hold.
struct DracoExpectation {
    std::size_t vertices;
    std::optional<std::size_t> triangles;  // nothing: any number
    std::size_t attributes;                // that somebody reads
    std::size_t limit;                     // bytes of memory that decoding may take, about
};

// What Draco holds of a corner of a triangle while it decodes, in bytes: corner table, traversal, faces.
constexpr std::size_t dracoBytesPerCorner = 32;

// Decodes a triangle mesh of Draco's bitstream 2.2, the one that glTF names. The library believes a stream's
// counts; here they are held against the expectation before memory or time is spent on them. The mesh has
// `vertices` points and `triangles` faces. Throws std::runtime_error: one line without a name.
std::unique_ptr<draco::Mesh> decodeDracoStream(std::span<const unsigned char> stream,
                                               const DracoExpectation& expected);

}  // namespace diptych::gltf
