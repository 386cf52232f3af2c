// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"
#include "shared/image/primaries.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// 8 bits per component, row 0 on top; 3 (RGB) or 4 (RGBA) components.
struct Image8 {
    int width = 0, height = 0, components = 3;
    std::vector<std::uint8_t> data;
};

// Replaces `file` atomically; uses a palette if an RGB image has at most 256 colours. Throws
// std::runtime_error that names the file.
void writePng(const std::filesystem::path& file, const Image8& image);

// The bytes that writePng() would write.
std::string pngBytes(const Image8& image);

// The values of a PNG: value / 255 or value / 65535 per component, converted to Rec. 709 if cHRM has other
// primaries.
struct PngImage {
    Image image;          // Y, YA, RGB or RGBA: palettes are expanded, transparent colours become alpha
    Image8 coded{};       // replaces `image`, same components
    int bits = 8;         // 16, or 8 for files of at most 8 bits, whose values fit exactly
    bool linear = false;  // gamma 1 (gAMA without sRGB); otherwise sRGB-encoded
    FileNotes notes{};
};

// Whether 8-bit components become floats, or stay 8 bits for a quarter of the memory.
enum class EightBits { decoded, kept };

// Reads a PNG. An interlaced file needs additional memory for all stored rows. Rejects files that need
// more than `max` bytes decoded. Throws std::runtime_error, one line that names file and fault.
PngImage readPngImage(std::span<const std::byte> bytes, const std::string& name,
                      std::uint64_t max = limits::imageBytes(), EightBits eight = EightBits::decoded);

// Reads only the header. Throws std::runtime_error without the file's name.
ImageSize pngSize(std::span<const std::byte> bytes, EightBits eight);

// Reads a PNG as 8-bit RGBA.
Image8 readPng(const std::filesystem::path& file);
Image8 readPng(std::span<const std::byte> bytes, const std::string& name,
               std::uint64_t max = limits::imageBytes());

// The size of a PNG as RGBA, from its header: 16 bits per component if `deep`, otherwise 8.
struct PngRgba {
    std::uint32_t width = 0, height = 0;
    bool deep = false;
    std::size_t rowBytes() const { return std::size_t{width} * (deep ? 8 : 4); }
};

// Decodes the pixels without a copy of the rows: RGBA as stored, row 0 on top, 16-bit components in native
// byte order. `pixels` has expected.height rows of expected.rowBytes() bytes. Ignores gamma and colour
// profiles; an image without alpha is opaque. Throws std::runtime_error without the file's name if the
// file does not decode or differs from `expected`.
void readPngRgba(std::span<const std::byte> bytes, const PngRgba& expected, unsigned char* pixels);

}  // namespace diptych
