// SPDX-License-Identifier: MIT
// Limits on the resources that a file may request, with reasons. Exceeding one is an error.
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::gltf {

// An accessor without a bufferView is zero except for sparse elements. It costs a few bytes in the file,
// and up to 16 bytes per vertex and attribute in memory.
constexpr std::size_t MAX_ZERO_ELEMENTS = std::size_t(1) << 24;

// A file of a few kilobytes may use one accessor in a thousand primitives. Geometry and animations may
// decode to FREE_DECODED_BYTES plus this many times the bytes of the buffers. For example, a quantized
// vertex of 4 bytes decodes to 44, and every corner of a strip with 1-byte indices may become a vertex.
constexpr std::size_t FREE_DECODED_BYTES = std::size_t(256) << 20;
constexpr std::size_t DECODED_BYTES_PER_BYTE = 32;

// One scene file, buffer or image file. A .glb cannot exceed it: its lengths have 32 bits.
constexpr std::uint64_t MAX_FILE_BYTES = std::uint64_t(4) << 30;

// All buffers together.
constexpr std::uint64_t MAX_BUFFER_BYTES = std::uint64_t(8) << 30;

// All encoded image files that materials use: as many 16384 x 16384 PNGs as fit into memory decoded.
constexpr std::uint64_t MAX_ENCODED_IMAGE_BYTES = std::uint64_t(2) << 30;

// The JSON text, and its objects and values, checked before parsing. A million nodes take 60 to 100 MiB of
// text. A value takes at least 16 bytes twice. An empty node, the object with the most memory for its
// length, takes about 600 bytes in the parser's and our trees, an accessor 900. In total this is below 2
// GiB.
constexpr std::uint64_t MAX_JSON_BYTES = std::uint64_t(256) << 20;
constexpr std::size_t MAX_JSON_OBJECTS = std::size_t(1) << 21;
constexpr std::size_t MAX_JSON_VALUES = std::size_t(1) << 25;

// Limits defined elsewhere: nesting, json_depth (shared/text/json_shape.h); images, texture_side
// (shared/image/limits.h); scans of a JPEG (shared/scene/image/jpeg.cpp); coordinates, maxCoordinate
// (shared/scene/model/scene.h).

}  // namespace diptych::gltf
