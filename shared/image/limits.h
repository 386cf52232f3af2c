// SPDX-License-Identifier: MIT
// Limits on the size that an image file may claim. A few bytes can claim a size beyond any memory, so
// every reader checks these before it allocates.
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::limits {

// Pixels per side: four times what GPUs can render, and enough for the largest panoramas in use. The
// product of two sides and any number of channels stays far below 2^63.
inline constexpr std::int64_t image_side = 65536;

// Pixels per side of a texture: the largest that GPUs and lavapipe support (maxImageDimension2D).
inline constexpr std::int64_t texture_side = 16384;

// Channels of an EXR file: ours have about 50; light groups and ids of film renderers about 300.
inline constexpr std::int64_t image_channels = 1024;

// Parts of an EXR file (passes, light groups, eyes), and string attributes per part.
inline constexpr std::int64_t image_parts = 1024, image_attributes = 65536;

// Bytes of one decoded file: a 7680 x 4320 frame with 64 float32 channels, or half the machine's memory if
// that is less.
std::uint64_t imageBytes();

// Largest expansion of one byte of deflate: a match of 258 bytes takes two bits (RFC 1951, 1996).
inline constexpr std::int64_t deflate_ratio = 1032;

}  // namespace diptych::limits

namespace diptych {

// The claims of a header, checked before anything is allocated.
struct ImageSize {
    std::int64_t width = 0, height = 0;
    std::int64_t bytes_per_pixel = 0;  // during decoding
};

// Throws std::runtime_error if an image of this size exceeds the limits or needs more than `max` bytes:
// "claims 100000 x 4 pixels; each side must be 1 to 65536".
void checkImageSize(std::int64_t width, std::int64_t height, std::int64_t bytesPerPixel, std::uint64_t max);

// For a file that is too short for its image even at the best compression.
[[noreturn]] void failToHold(std::int64_t width, std::int64_t height, std::size_t fileBytes);

}  // namespace diptych
