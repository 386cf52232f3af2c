// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace diptych {

// The header of an encoded image, read before any pixel is decoded.
struct ImageHeader {
    enum class Kind { png, jpeg, webp };
    Kind kind = Kind::png;
    std::int64_t width = 0, height = 0;
    bool deep = false;                 // 16 bits per component
    std::int64_t pixels_per_byte = 1;  // upper bound of the pixels that one byte of the file can encode

    std::uint64_t bytes() const {  // decoded, RGBA
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * (deep ? 8 : 4);
    }
};

}  // namespace diptych
