// SPDX-License-Identifier: MIT
// TIFF files made byte by byte, independent of the library that reads them.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace diptych {

// TIFF 6.0, section 2: a header, a directory with 12 bytes per tag, and one strip behind it.
// Little-endian.
struct MadeTiff {
    // TIFF tags: 256 width, 257 height, 258 bits, 259 compression, 262 colours, 273 offset, 277 samples,
    // 278 rows per strip, 279 bytes, 284 planes, 339 format, 274 orientation.
    std::map<int, std::uint32_t> tags;
    std::string strip;

    std::string bytes() const {
        std::string out("II*\0\x08\0\0\0", 8);
        const auto put = [&](std::uint32_t value, int size) {
            for (int i = 0; i < size; ++i) out += static_cast<char>(value >> (8 * i));
        };
        put(static_cast<std::uint32_t>(tags.size()), 2);
        // With several samples, bits and format are written only once; libtiff applies them to all.
        const std::uint32_t begin = static_cast<std::uint32_t>(8 + 2 + 12 * tags.size() + 4);
        for (const auto& [tag, value] : tags) {
            put(static_cast<std::uint32_t>(tag), 2);
            put(4, 2);  // LONG
            put(1, 4);
            put(tag == 273 ? begin : value, 4);
        }
        put(0, 4);
        return out + strip;
    }
};

inline MadeTiff madeTiff(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint32_t bits,
                         std::uint32_t format, const std::string& strip) {
    const auto bytes = static_cast<std::uint32_t>(strip.size());
    return {{{256, width},
             {257, height},
             {258, bits},
             {259, 1},
             {262, samples < 3 ? 1u : 2u},
             {273, 0},
             {277, samples},
             {278, height},
             {279, bytes},
             {284, 1},
             {339, format}},
            strip};
}

}  // namespace diptych
