// SPDX-License-Identifier: MIT
// What an image file may claim. A few bytes can name a size that no memory holds, so every reader asks here
// before it allocates.
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::limits {

// Pixels a side: four times what GPUs draw, room for every panorama in use; the product of two sides
// with any number of channels stays far below 2^63.
inline constexpr std::int64_t image_side = 65536;

// A texture's side in pixels: the largest that GPUs and lavapipe take (maxImageDimension2D).
inline constexpr std::int64_t texture_side = 16384;

// Channels of an EXR file: ours have some 50, light groups and ids of film renderers some 300.
inline constexpr std::int64_t image_channels = 1024;

// Parts of an EXR file, one a pass or light group and eye; and the string attributes of each.
inline constexpr std::int64_t image_parts = 1024, image_attributes = 65536;

// Bytes of one decoded file: a 7680 x 4320 frame of 64 float32 channels. Where the machine has less than
// twice that, half its memory.
std::uint64_t imageBytes();

// The most that one byte of deflate unfolds to: a match of 258 bytes takes two bits (RFC 1951, 1996).
inline constexpr std::int64_t deflate_ratio = 1032;

}  // namespace diptych::limits

namespace diptych {

// Throws std::runtime_error where an image of this size is beyond the limits, or needs over `most` bytes:
// "claims 100000 x 4 pixels: 1 to 65536 a side are read".
void checkImageSize(std::int64_t width, std::int64_t height, std::int64_t bytesPerPixel, std::uint64_t most);

// For a file too short for its picture, however well it is compressed.
[[noreturn]] void failToHold(std::int64_t width, std::int64_t height, std::size_t fileBytes);

}  // namespace diptych
