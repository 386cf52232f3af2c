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

// 8 bits a component, row 0 on top; 3 (RGB) or 4 (RGBA) components.
struct Image8 {
    int width = 0, height = 0, components = 3;
    std::vector<std::uint8_t> data;
};

// Written beside `file` and renamed; with a palette where an RGB picture has at most 256 colours. Throws
// std::runtime_error naming the file.
void writePng(const std::filesystem::path& file, const Image8& image);

// The bytes that writePng() writes.
std::string pngBytes(const Image8& image);

// The values of a PNG: value / 255 or value / 65535 for each component; where cHRM has other primaries,
// converted to Rec. 709's.
struct PngPicture {
    Image image;          // Y, YA, RGB or RGBA: palettes are expanded, transparent colours become an A
    Image8 coded{};       // in place of `image`, the same components
    int bits = 8;         // 16, or 8 for files of 8 or fewer bits, whose values 8 bits hold exactly
    bool linear = false;  // its gamma is 1 (gAMA, without an sRGB chunk); otherwise it counts as sRGB-encoded
    FileNotes notes{};
};

// Whether 8 bits a component become floats, or stay what they are for a quarter of the memory.
enum class EightBits { decoded, kept };

// Reads a PNG. An interlaced file needs memory for all stored rows in addition. Refuses what needs more than
// `most` bytes decoded. Throws std::runtime_error, one line naming file and fault.
PngPicture readPngPicture(std::span<const std::byte> bytes, const std::string& name,
                          std::uint64_t most = limits::imageBytes(), EightBits eight = EightBits::decoded);

// From its header. Throws std::runtime_error without the file's name.
PictureSize pngSize(std::span<const std::byte> bytes, EightBits eight);

// Reads a PNG as RGBA, 8 bits.
Image8 readPng(const std::filesystem::path& file);
Image8 readPng(std::span<const std::byte> bytes, const std::string& name,
               std::uint64_t most = limits::imageBytes());

// The size of a PNG as RGBA, from its header: 16 bits a component if `deep`, otherwise 8.
struct PngRgba {
    std::uint32_t width = 0, height = 0;
    bool deep = false;
    std::size_t rowBytes() const { return std::size_t{width} * (deep ? 8 : 4); }
};

// Decodes the pixels without a copy of the rows: RGBA as stored, row 0 on top, 16 bit components in the
// machine's byte order, into memory of expected.height rows of expected.rowBytes() bytes. Gammas and colour
// profiles are ignored; a picture without alpha is opaque. Throws std::runtime_error without the file's name
// if the file does not decode or differs from `expected`.
void readPngRgba(std::span<const std::byte> bytes, const PngRgba& expected, unsigned char* pixels);

}  // namespace diptych
