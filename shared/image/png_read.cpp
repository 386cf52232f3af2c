// SPDX-License-Identifier: MIT
// Source: PNG specification (ISO/IEC 15948); numbers in comments are its chapters.
#include "shared/image/chunks.h"
#include "shared/image/file_bytes.h"
#include "shared/image/png.h"
#include "shared/image/png_decoder.h"
#include "shared/image/primaries.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

// ---- what stands before the pixels -------------------------------------------------------------------

// 4.3, 11.3.2: encoding of the values.
struct Encoding {
    bool linear = false;
    std::optional<glm::dmat3> to_rec709{};
    FileNotes notes{};
};

Primaries primariesOf(const Chunk& chunk) {
    Primaries primaries{};
    for (std::size_t i = 0; i < primaries.size(); ++i)  // the white point is first
        primaries[i] = bigEndian(chunk.data, 4 * ((i + 2) % primaries.size())) / 100000.0;
    return primaries;
}

// 4.3: cICP and iCCP take precedence over sRGB, which takes precedence over gAMA and cHRM. Writers of sRGB
// store a gAMA close to 1/2.2. cICP (third edition, 11.3.2.6) of 1, 13, 0, 1 is sRGB.
Encoding encodingOf(std::span<const std::byte> file) {
    constexpr std::uint32_t one = 100000, srgb = 45455, rounding = 100;
    std::uint32_t gamma = 0, frames = 1;
    std::optional<Primaries> primaries;
    bool is_srgb = false;
    std::string_view profile, code;
    Encoding encoding;
    visitPng(file, [&](const Chunk& chunk) {
        if (chunk.name == "IDAT") return false;
        if (chunk.name == "gAMA") gamma = bigEndian(chunk.data, 0);
        if (chunk.name == "cHRM") primaries = primariesOf(chunk);
        if (chunk.name == "sRGB") is_srgb = true;
        if (chunk.name == "iCCP") profile = chunk.data;
        if (chunk.name == "cICP" && chunk.data.size() == 4) code = chunk.data;
        if (chunk.name == "acTL") frames = bigEndian(chunk.data, 0);
        if (chunk.name == "pHYs" && bigEndian(chunk.data, 0) > 0)
            noteAspect(static_cast<double>(bigEndian(chunk.data, 4)) / bigEndian(chunk.data, 0),
                       encoding.notes);
        return true;
    });
    const bool stated = gamma != 0 && !is_srgb;
    encoding.linear = stated && gamma == one;
    const char* const taken_as = encoding.linear ? "linear" : "sRGB";
    auto& not_applied = encoding.notes.not_applied;
    if (stated && !encoding.linear && (gamma + rounding < srgb || gamma > srgb + rounding))
        not_applied.push_back(fmt::format("its gamma of {} is not applied; its values are read as sRGB",
                                          static_cast<double>(gamma) / one));
    using namespace std::string_view_literals;
    if (!code.empty() && code != "\1\15\0\1"sv)
        not_applied.push_back(fmt::format(
            "its colour code points {} {} {} {} (ITU-T H.273) are not applied; its values are read as {}",
            bigEndian(code, 0, 1), bigEndian(code, 1, 1), bigEndian(code, 2, 1), bigEndian(code, 3, 1),
            taken_as));
    else if (code.empty() && !profile.empty())
        noteProfile(profile, taken_as, encoding.notes);
    else if (code.empty() && !is_srgb && primaries)
        encoding.to_rec709 = matrixToRec709(*primaries, encoding.notes);
    if (frames > 1)
        encoding.notes.in_part.push_back(fmt::format("only the first of its {} frames is read", frames));
    return encoding;
}

// ---- the pixels --------------------------------------------------------------------------------------

// 11.2.2: bit depth and colour type are in IHDR, the first chunk, which libpng has checked.
std::int64_t storedBits(std::span<const std::byte> file) {
    constexpr std::size_t depth = 24, color = 25;
    constexpr std::array<std::int64_t, 7> components{1, 0, 3, 1, 2, 0, 4};
    return std::to_integer<std::int64_t>(file[depth]) *
           components.at(std::to_integer<std::size_t>(file[color]));
}

// The compressed data are rows: a filter byte, then the pixels, padded to whole bytes.
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

bool isConverted(const PngDecoder& decoder, const Encoding& encoding) {
    return encoding.to_rec709 && decoder.components() >= 3;
}

bool isKept(const PngDecoder& decoder, const Encoding& encoding, EightBits eight) {
    return eight == EightBits::kept && decoder.bits() == 8 && !isConverted(decoder, encoding);
}

ImageSize sizeOf(const PngDecoder& decoder, bool kept) {
    const int bytes = kept ? 1 : static_cast<int>(sizeof(float));
    const int rows = decoder.isInterlaced() && !kept ? decoder.bits() / 8 : 0;
    return {decoder.width(), decoder.height(), std::int64_t{bytes + rows} * decoder.components()};
}

PngImage decode(std::span<const std::byte> bytes, std::uint64_t max, EightBits eight) {
    PngDecoder decoder(bytes, PngDecoder::Rows::as_stored, cutShort);
    decoder.readHeader();
    Encoding encoding = encodingOf(bytes);
    const bool kept = isKept(decoder, encoding, eight);
    const auto [width, height, bytesPerPixel] = sizeOf(decoder, kept);
    checkImageSize(width, height, bytesPerPixel, max);
    const int components = decoder.components(), bits = decoder.bits();
    const bool interlaced = decoder.isInterlaced();
    checkDeflated(width, height, storedBits(bytes), bytes.size());
    const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(components);
    if (decoder.rowBytes() != row * static_cast<std::size_t>(bits / 8)) fail(headerChanges);
    const auto lines = static_cast<std::size_t>(height);
    PngImage image;
    image.bits = bits;
    image.linear = encoding.linear;
    image.notes = std::move(encoding.notes);
    if (kept) {
        image.coded = {static_cast<int>(width), static_cast<int>(height), components,
                       std::vector<std::uint8_t>(row * lines)};
        if (interlaced) decoder.readAll(image.coded.data.data());
        for (std::size_t y = 0; !interlaced && y < lines; ++y)
            decoder.readRow(image.coded.data.data() + row * y);
        return image;
    }
    image.image = Image(static_cast<int>(width), static_cast<int>(height), components);
    const auto rows =
        std::make_unique_for_overwrite<png_byte[]>(decoder.rowBytes() * (interlaced ? lines : 1));
    if (interlaced) decoder.readAll(rows.get());
    for (std::size_t y = 0; y < lines; ++y) {
        png_const_bytep from = rows.get();
        if (interlaced)
            from += y * decoder.rowBytes();
        else
            decoder.readRow(rows.get());
        float* to = image.image.data.data() + row * y;
        bits == 16 ? convert<std::uint16_t>(from, to, row) : convert<std::uint8_t>(from, to, row);
    }
    if (isConverted(decoder, encoding)) convertColors(image.image, *encoding.to_rec709, !encoding.linear);
    return image;
}

std::uint8_t byteOf(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * value));
}

}  // namespace

PngImage readPngImage(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max,
                      EightBits eight) {
    return named(name, [&] { return decode(bytes, max, eight); });
}

ImageSize pngSize(std::span<const std::byte> bytes, EightBits eight) {
    PngDecoder decoder(bytes, PngDecoder::Rows::as_stored, cutShort);
    decoder.readHeader();
    return sizeOf(decoder, isKept(decoder, encodingOf(bytes), eight));
}

void readPngRgba(std::span<const std::byte> bytes, const PngRgba& expected, unsigned char* pixels) {
    PngDecoder decoder(bytes, PngDecoder::Rows::rgba, "it ends early");
    decoder.readHeader();
    if (decoder.width() != expected.width || decoder.height() != expected.height ||
        decoder.rowBytes() != expected.rowBytes())
        fail(headerChanges);
    decoder.readAll(pixels);
}

Image8 readPng(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    const Image image = readPngImage(bytes, name, max).image;
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
