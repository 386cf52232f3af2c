// SPDX-License-Identifier: MIT
// Source: PNG specification (ISO/IEC 15948); numbers in comments are its chapters.
#include "shared/image/file_bytes.h"
#include "shared/image/png.h"
#include "shared/image/png_decoder.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace diptych {
namespace {

// ---- what stands before the pixels -------------------------------------------------------------------

// 4.3, 11.3.3: the meaning of the values. Profiles are not decompressed; that there is one is noted.
struct Encoding {
    std::uint32_t gamma = 0;  // in 1/100000, as the file has it; 0: none
    bool srgb = false, profile = false;
};

Encoding encodingOf(std::span<const std::byte> file) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value;
        std::memcpy(&value, file.data() + at, sizeof value);
        return std::endian::native == std::endian::little ? __builtin_bswap32(value) : value;
    };
    constexpr std::size_t signature = 8, around = 12;  // length, name and checksum around a chunk's data
    Encoding encoding;
    for (std::size_t at = signature; file.size() - at >= around;) {
        const std::size_t size = word(at);
        const std::string_view name(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
        if (name == "IDAT" || size > file.size() - at - around) break;
        if (name == "gAMA" && size == 4) encoding.gamma = word(at + 8);
        if (name == "sRGB") encoding.srgb = true;
        if (name == "iCCP" || name == "cICP") encoding.profile = true;
        at += around + size;
    }
    return encoding;
}

// sRGB takes precedence over gAMA (4.3); a gAMA close to 1/2.2 is what writers of sRGB store.
void describe(PngPicture& picture, const Encoding& encoding) {
    constexpr std::uint32_t linear = 100000, srgb = 45455, rounding = 100;
    const bool stated = encoding.gamma != 0 && !encoding.srgb;
    picture.linear = stated && encoding.gamma == linear;
    if (stated && !picture.linear && (encoding.gamma + rounding < srgb || encoding.gamma > srgb + rounding))
        picture.notes.push_back(fmt::format("its gamma of {} is not applied: its values are taken as sRGB's",
                                            static_cast<double>(encoding.gamma) / linear));
    if (encoding.profile)
        picture.notes.push_back(fmt::format("its colour profile is not applied: its values are taken as {}",
                                            picture.linear ? "linear" : "sRGB's"));
}

// ---- the pixels --------------------------------------------------------------------------------------

// 11.2.2: depth and colour are in IHDR, the first chunk, which libpng has checked.
std::int64_t storedBits(std::span<const std::byte> file) {
    constexpr std::size_t depth = 24, color = 25;
    constexpr std::array<std::int64_t, 7> components{1, 0, 3, 1, 2, 0, 4};
    return std::to_integer<std::int64_t>(file[depth]) *
           components.at(std::to_integer<std::size_t>(file[color]));
}

// The compressed data are rows: one byte for the filter and the pixels, padded to whole bytes.
void checkDeflated(std::int64_t width, std::int64_t height, std::int64_t bits, std::size_t size) {
    const auto rows = static_cast<double>(height * (1 + (width * bits + 7) / 8));
    if (rows > limits::deflate_ratio * static_cast<double>(size)) failToHold(width, height, size);
}

template <class T>
void convert(png_const_bytep row, float* to, std::size_t count) {
    constexpr float largest = std::numeric_limits<T>::max();
    for (std::size_t i = 0; i < count; ++i) {
        T value;
        std::memcpy(&value, row + i * sizeof value, sizeof value);
        to[i] = static_cast<float>(value) / largest;
    }
}

constexpr const char* headerChanges = "its header changes";

constexpr const char* cutShort = "is cut short";

bool isKept(const PngDecoder& decoder, EightBits eight) {
    return eight == EightBits::kept && decoder.bits() == 8;
}

PictureSize sizeOf(const PngDecoder& decoder, EightBits eight) {
    const int bytes = isKept(decoder, eight) ? 1 : static_cast<int>(sizeof(float));
    const int rows = decoder.isInterlaced() && !isKept(decoder, eight) ? decoder.bits() / 8 : 0;
    return {decoder.width(), decoder.height(), std::int64_t{bytes + rows} * decoder.components()};
}

PngPicture decode(std::span<const std::byte> bytes, std::uint64_t most, EightBits eight) {
    PngDecoder decoder(bytes, PngDecoder::Rows::as_stored, cutShort);
    decoder.readHeader();
    const auto [width, height, bytesPerPixel] = sizeOf(decoder, eight);
    checkImageSize(width, height, bytesPerPixel, most);
    const int components = decoder.components(), bits = decoder.bits();
    const bool interlaced = decoder.isInterlaced();
    checkDeflated(width, height, storedBits(bytes), bytes.size());
    const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(components);
    if (decoder.rowBytes() != row * static_cast<std::size_t>(bits / 8)) fail(headerChanges);
    const auto lines = static_cast<std::size_t>(height);
    PngPicture picture;
    picture.bits = bits;
    describe(picture, encodingOf(bytes));
    if (isKept(decoder, eight)) {
        picture.coded = {static_cast<int>(width), static_cast<int>(height), components,
                         std::vector<std::uint8_t>(row * lines)};
        if (interlaced) decoder.readAll(picture.coded.data.data());
        for (std::size_t y = 0; !interlaced && y < lines; ++y)
            decoder.readRow(picture.coded.data.data() + row * y);
        return picture;
    }
    picture.image = Image(static_cast<int>(width), static_cast<int>(height), components);
    const auto rows =
        std::make_unique_for_overwrite<png_byte[]>(decoder.rowBytes() * (interlaced ? lines : 1));
    if (interlaced) decoder.readAll(rows.get());
    for (std::size_t y = 0; y < lines; ++y) {
        png_const_bytep from = rows.get();
        if (interlaced)
            from += y * decoder.rowBytes();
        else
            decoder.readRow(rows.get());
        float* to = picture.image.data.data() + row * y;
        bits == 16 ? convert<std::uint16_t>(from, to, row) : convert<std::uint8_t>(from, to, row);
    }
    return picture;
}

std::uint8_t byteOf(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * value));
}

}  // namespace

PngPicture readPngPicture(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most,
                          EightBits eight) {
    return named(name, [&] { return decode(bytes, most, eight); });
}

PictureSize pngSize(std::span<const std::byte> bytes, EightBits eight) {
    PngDecoder decoder(bytes, PngDecoder::Rows::as_stored, cutShort);
    decoder.readHeader();
    return sizeOf(decoder, eight);
}

void readPngRgba(std::span<const std::byte> bytes, const PngRgba& expected, unsigned char* pixels) {
    PngDecoder decoder(bytes, PngDecoder::Rows::rgba, "it ends early");
    decoder.readHeader();
    if (decoder.width() != expected.width || decoder.height() != expected.height ||
        decoder.rowBytes() != expected.rowBytes())
        fail(headerChanges);
    decoder.readAll(pixels);
}

Image8 readPng(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    const Image image = readPngPicture(bytes, name, most).image;
    Image8 rgba{image.width, image.height, 4, std::vector<std::uint8_t>(4 * image.pixels())};
    const int colors = image.components > 2 ? 3 : 1;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* from = image.pixel(i);
        for (int c = 0; c < 3; ++c)
            rgba.data[4 * i + static_cast<std::size_t>(c)] = byteOf(from[std::min(c, colors - 1)]);
        rgba.data[4 * i + 3] = image.components > colors ? byteOf(from[colors]) : std::uint8_t{255};
    }
    return rgba;
}

Image8 readPng(const std::filesystem::path& file) {
    return readPng(std::as_bytes(std::span<const unsigned char>(bytesOf(file))), file.string());
}

}  // namespace diptych
