// SPDX-License-Identifier: MIT
// Reads the chunks of PNG and JPEG files that are not pixels. The file is untrusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace diptych {

struct Chunk {
    std::string_view name;  // "gAMA"; for a JPEG segment the second byte of its marker
    std::string_view data;
};

// Big-endian unsigned number of `size` bytes at `at`; 0 if `data` is too short.
std::uint32_t bigEndian(std::string_view data, std::size_t at, std::size_t size = 4);

// Calls `take` for every chunk of a PNG, or every segment of a JPEG before its first scan, until it
// returns false or the file ends. Checksums are not checked.
using TakeChunk = std::function<bool(const Chunk&)>;
void visitPng(std::span<const std::byte> file, const TakeChunk& take);
void visitJpeg(std::span<const std::byte> file, const TakeChunk& take);

}  // namespace diptych
