// SPDX-License-Identifier: MIT
// How much a file may ask of its reader: each limit with its reason. Beyond one there is an error that says
// so.
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::gltf {

// An accessor without a bufferView is all zeros but for its sparse elements: it costs the file a few bytes,
// and the reader up to 16 a vertex and attribute.
constexpr std::size_t MAX_ZERO_ELEMENTS = std::size_t(1) << 24;

// A file of a few kilobytes may name one accessor from a thousand primitives. What its geometry and its
// motion decode to may be this much, and beyond that this many times the bytes that its buffers hold: a
// vertex of 4 bytes (quantized) decodes to 44, and every corner of a strip of 1 byte may become one.
constexpr std::size_t FREE_DECODED_BYTES = std::size_t(256) << 20;
constexpr std::size_t DECODED_BYTES_PER_BYTE = 32;

// A scene file, a buffer or an image file. A .glb cannot be larger: its lengths have 32 bits.
constexpr std::uint64_t MAX_FILE_BYTES = std::uint64_t(4) << 30;

// All buffers together.
constexpr std::uint64_t MAX_BUFFER_BYTES = std::uint64_t(8) << 30;

// The image files that materials read, as they are, together: as many 16384 x 16384 PNGs as memory holds
// decoded.
constexpr std::uint64_t MAX_ENCODED_IMAGE_BYTES = std::uint64_t(2) << 30;

// The JSON text, the objects in it and all its values, before it is parsed. A million nodes are 60 to 100 MiB
// of text. A value costs 16 bytes or more twice over, an empty node, of all objects the dearest for its
// length, some 600 bytes in the parser's tree and in ours, an accessor 900: below 2 GiB together.
constexpr std::uint64_t MAX_JSON_BYTES = std::uint64_t(256) << 20;
constexpr std::size_t MAX_JSON_OBJECTS = std::size_t(1) << 21;
constexpr std::size_t MAX_JSON_VALUES = std::size_t(1) << 25;

// How deep it nests: json_depth (shared/text/json_shape.h). Images: texture_side (shared/image/limits.h), and
// scans of a JPEG (image_jpeg.cpp). Coordinates: maxCoordinate (shared/scene/scene.h).

}  // namespace diptych::gltf
