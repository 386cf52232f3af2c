// SPDX-License-Identifier: MIT
#include "shared/image/png.h"
#include "shared/image/limits.h"
#include "shared/scene/image/codecs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

namespace diptych::codec {

// PNG specification (ISO/IEC 15948), 11.2.2: IHDR is the first chunk.
ImageHeader readPngHeader(Bytes encoded) {
    constexpr std::array<unsigned char, 8> ihdr{0, 0, 0, 13, 'I', 'H', 'D', 'R'};
    if (encoded.size() < 33 || !std::equal(ihdr.begin(), ihdr.end(), encoded.begin() + 8))
        failDecoding("it does not begin with a header");
    const auto word = [&](std::size_t at) {
        return std::int64_t{encoded[at]} << 24 | std::int64_t{encoded[at + 1]} << 16 |
               std::int64_t{encoded[at + 2]} << 8 | std::int64_t{encoded[at + 3]};
    };
    const int depth = encoded[24], color = encoded[25];  // libpng checks both later
    const int bits = std::max(depth, 1) * (color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1);
    return {ImageHeader::Kind::png, word(16), word(20), depth == 16, 8 * limits::deflate_ratio / bits};
}

void decodePng(Bytes encoded, const ImageHeader& header, unsigned char* pixels) {
    const PngRgba expected{static_cast<std::uint32_t>(header.width),
                           static_cast<std::uint32_t>(header.height), header.deep};
    try {
        readPngRgba(std::as_bytes(encoded), expected, pixels);
    } catch (const std::runtime_error& error) {
        failDecoding(error.what());
    }
}

}  // namespace diptych::codec
