// SPDX-License-Identifier: MIT
// libpng drops chunks with a wrong checksum, and the mutation with them. Most of the time checksums are
// corrected.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max,
                                               unsigned int seed) {
    size = LLVMFuzzerMutate(data, size, max);
    if (size < 8 || data[0] != 0x89 || seed % 16 == 0) return size;
    const auto word = [&](std::size_t at) {
        return std::size_t{data[at]} << 24 | std::size_t{data[at + 1]} << 16 |
               std::size_t{data[at + 2]} << 8 | data[at + 3];
    };
    // Length, name, data, and the checksum of name and data.
    constexpr std::size_t frame = 12;
    for (std::size_t at = 8; at + frame <= size && word(at) <= size - at - frame; at += frame + word(at)) {
        const std::size_t length = word(at);
        const auto sum = static_cast<std::uint32_t>(::crc32(0, data + at + 4, static_cast<uInt>(length + 4)));
        for (std::size_t i = 0; i < 4; ++i)
            data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    }
    return size;
}
