// SPDX-License-Identifier: MIT
// What stands in PNG and JPEG files beside the pixels, read without trusting it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace diptych {

struct Chunk {
    std::string_view name;  // "gAMA"; of a JPEG's segment its marker's second byte
    std::string_view data;
};

// Unsigned number of `size` bytes from `at` on, the highest first; 0 where they are not there.
std::uint32_t bigEndian(std::string_view data, std::size_t at, std::size_t size = 4);

// Calls `take` for every chunk of a PNG, or segment of a JPEG before its first scan, until it returns false
// or the file's end is reached. Checksums are not checked.
using TakeChunk = std::function<bool(const Chunk&)>;
void visitPng(std::span<const std::byte> file, const TakeChunk& take);
void visitJpeg(std::span<const std::byte> file, const TakeChunk& take);

}  // namespace diptych
