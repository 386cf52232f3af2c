// SPDX-License-Identifier: MIT
#include "shared/scene/image/decode.h"

#include "shared/image/limits.h"
#include "shared/scene/image/codecs.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace diptych {

namespace {

constexpr std::int64_t maxSide = limits::texture_side;

bool beginsWith(std::span<const unsigned char> encoded, std::span<const unsigned char> signature) {
    return encoded.size() > signature.size() &&
           std::equal(signature.begin(), signature.end(), encoded.begin());
}

std::string_view textOf(std::span<const unsigned char> encoded) {
    return {reinterpret_cast<const char*>(encoded.data()), encoded.size()};
}

// Google, WebP container specification: RIFF, four bytes of length, WEBP.
bool isWebp(std::string_view text) {
    return text.starts_with("RIFF") && text.size() >= 12 && text.substr(8, 4) == "WEBP";
}

// Names the format of a file that is not supported, by its first bytes; empty if unknown. Sources: W3C,
// GIF89a; Khronos, KTX and KTX 2.0; Adobe, TIFF 6.0; ISO/IEC 23008-12 and AOM, AVIF; Microsoft,
// BITMAPFILEHEADER and DDS.
std::string_view otherKind(std::string_view text) {
    const auto brand = [&](std::string_view name) { return text.substr(4, 8) == name; };
    if (text.starts_with("GIF87a") || text.starts_with("GIF89a")) return "GIF";
    if (text.starts_with("\xabKTX 20\xbb\r\n\x1a\n")) return "KTX2";
    if (text.starts_with("\xabKTX 11\xbb\r\n\x1a\n")) return "KTX";
    if (text.starts_with(std::string_view("II*\0", 4)) || text.starts_with(std::string_view("MM\0*", 4)))
        return "TIFF";
    if (text.size() >= 12 && (brand("ftypavif") || brand("ftypavis"))) return "AVIF";
    if (text.starts_with("DDS ")) return "DDS";
    // Text may also begin with "BM"; a BMP header has zeros in its reserved words, too.
    if (text.starts_with("BM") && text.size() >= 14 && text.substr(6, 4) == std::string_view("\0\0\0\0", 4))
        return "BMP";
    return {};
}

ImageHeader uncheckedHeader(std::span<const unsigned char> encoded) {
    constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<unsigned char, 3> jpeg{0xff, 0xd8, 0xff};
    if (beginsWith(encoded, png)) return codec::readPngHeader(encoded);
    if (beginsWith(encoded, jpeg)) return codec::readJpegHeader(encoded);
    if (isWebp(textOf(encoded))) return codec::readWebpHeader(encoded);
    const std::string_view kind = otherKind(textOf(encoded));
    fail(kind.empty() ? "is not PNG, JPEG or WebP"
                      : fmt::format("is {}; only PNG, JPEG and WebP are supported", kind));
}

}  // namespace

ImageHeader imageHeader(std::span<const unsigned char> encoded) {
    const ImageHeader header = uncheckedHeader(encoded);
    const std::int64_t width = header.width, height = header.height;
    if (width < 1 || height < 1 || width > maxSide || height > maxSide)
        fail(fmt::format("has {} x {} pixels; each side must be 1 to {}", width, height, maxSide));
    if (width * height / header.pixels_per_byte > static_cast<std::int64_t>(encoded.size()))
        fail(fmt::format("claims {} x {} pixels, too many for its {} bytes", width, height, encoded.size()));
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
    const auto decode = header.kind == ImageHeader::Kind::png    ? codec::decodePng
                        : header.kind == ImageHeader::Kind::jpeg ? codec::decodeJpeg
                                                                 : codec::decodeWebp;
    decode(encoded, header, pixels);
    return image;
}

}  // namespace diptych
