// SPDX-License-Identifier: MIT
// Limits on what a file may ask of its reader, each with its reason. Exceeding one is an error that says so.
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::gltf {

// An accessor without a bufferView is all zeros but for its sparse elements: it costs the file a few bytes,
// and the reader up to 16 bytes for each vertex and attribute.
constexpr std::size_t MAX_ZERO_ELEMENTS = std::size_t(1) << 24;

// A file of a few kilobytes may name one accessor from a thousand primitives. Its geometry and animations
// may decode to FREE_DECODED_BYTES and, in addition, to this many times the bytes of its buffers: a
// quantized vertex of 4 bytes decodes to 44, and every corner of a strip with indices of 1 byte may become a
// vertex.
constexpr std::size_t FREE_DECODED_BYTES = std::size_t(256) << 20;
constexpr std::size_t DECODED_BYTES_PER_BYTE = 32;

// One scene file, buffer or image file. A .glb cannot be larger: its lengths have 32 bits.
constexpr std::uint64_t MAX_FILE_BYTES = std::uint64_t(4) << 30;

// All buffers together.
constexpr std::uint64_t MAX_BUFFER_BYTES = std::uint64_t(8) << 30;

// All encoded image files that materials read together: as many 16384 x 16384 PNGs as fit into memory
// decoded.
constexpr std::uint64_t MAX_ENCODED_IMAGE_BYTES = std::uint64_t(2) << 30;

// The JSON text, and the number of objects and of values in it, before it is parsed. A million nodes are 60
// to 100 MiB of text. A value takes at least 16 bytes twice, an empty node (the object with the most memory
// for its length) some 600 bytes in the parser's tree and in ours, an accessor 900: together below 2 GiB.
constexpr std::uint64_t MAX_JSON_BYTES = std::uint64_t(256) << 20;
constexpr std::size_t MAX_JSON_OBJECTS = std::size_t(1) << 21;
constexpr std::size_t MAX_JSON_VALUES = std::size_t(1) << 25;

// Limits defined elsewhere: nesting, json_depth (shared/text/json_shape.h); images, texture_side
// (shared/image/limits.h), and scans of a JPEG (shared/scene/image/jpeg.cpp); coordinates, maxCoordinate
// (shared/scene/model/scene.h).

}  // namespace diptych::gltf
