// SPDX-License-Identifier: MIT
#include "shared/scene/image_decode.h"

#include "shared/image/limits.h"
#include "shared/scene/image_codecs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace diptych {

namespace {

constexpr std::int64_t maxSide = limits::texture_side;

bool beginsWith(std::span<const unsigned char> encoded, std::span<const unsigned char> signature) {
    return encoded.size() > signature.size() &&
           std::equal(signature.begin(), signature.end(), encoded.begin());
}

}  // namespace

void codec::failDecoding(const char* why) {
    throw std::runtime_error(fmt::format("does not decode: {}", why));
}

std::uint64_t ImageHeader::bytes() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * (deep ? 8 : 4);
}

ImageHeader imageHeader(std::span<const unsigned char> encoded) {
    constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<unsigned char, 3> jpeg{0xff, 0xd8, 0xff};
    const bool isPng = beginsWith(encoded, png);
    if (!isPng && !beginsWith(encoded, jpeg)) throw std::runtime_error("is neither PNG nor JPEG");
    const ImageHeader header = isPng ? codec::readPngHeader(encoded) : codec::readJpegHeader(encoded);
    const std::int64_t width = header.width, height = header.height;
    if (width < 1 || height < 1 || width > maxSide || height > maxSide)
        throw std::runtime_error(
            fmt::format("is {} x {} pixels: from 1 to {} a side are read", width, height, maxSide));
    if (width * height / header.pixels_per_byte > static_cast<std::int64_t>(encoded.size()))
        throw std::runtime_error(fmt::format("claims {} x {} pixels, which its {} bytes cannot hold", width,
                                             height, encoded.size()));
    return header;
}

TextureImage decodeImage(std::span<const unsigned char> encoded) {
    const ImageHeader header = imageHeader(encoded);
    TextureImage image;
    image.width = static_cast<int>(header.width);
    image.height = static_cast<int>(header.height);
    unsigned char* pixels = nullptr;
    if (header.deep) {
        image.rgba16.resize(header.bytes() / 2);
        pixels = reinterpret_cast<unsigned char*>(image.rgba16.data());
    } else {
        image.rgba.resize(header.bytes());
        pixels = image.rgba.data();
    }
    (header.kind == ImageHeader::Kind::png ? codec::decodePng : codec::decodeJpeg)(encoded, header, pixels);
    return image;
}

}  // namespace diptych
