// SPDX-License-Identifier: MIT
#include "shared/image/image_file.h"

#include "shared/image/chunks.h"
#include "shared/image/exr.h"
#include "shared/image/exr_header.h"
#include "shared/image/file_bytes.h"
#include "shared/image/image_rows.h"
#include "shared/image/jpeg_decoder.h"
#include "shared/image/orientation.h"
#include "shared/image/pfm.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
#include "shared/image/tiff.h"
#include "shared/text/counted.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

ImageFile ofOneLayer(std::string format, std::string sample, Image image, Image8 coded = {}) {
    static const std::vector<std::vector<std::string>> names{
        {}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    const bool kept = image.empty();
    ImageFile file{
        kept ? coded.width : image.width, kept ? coded.height : image.height, std::move(format), false, {}};
    const auto components = static_cast<std::size_t>(kept ? coded.components : image.components);
    file.layers.push_back(
        {"", names.at(components), std::move(sample), std::move(image), {}, std::move(coded)});
    return file;
}

// Applies the orientation of the file.
void orient(ImageFile& file, int orientation) {
    ImageLayer& layer = file.layers.front();
    layer.image = oriented(std::move(layer.image), orientation);
    layer.coded = oriented(std::move(layer.coded), orientation);
    if (orientation >= 5) std::swap(file.width, file.height);
}

ImageFile imageOfPng(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max,
                     EightBits eight) {
    PngImage png = readPngImage(bytes, name, max, eight);
    ImageFile file =
        ofOneLayer("PNG", png.bits == 16 ? "16 bit" : "8 bit", std::move(png.image), std::move(png.coded));
    orient(file, orientationOfPng(bytes));
    file.display_referred = !png.linear;
    file.straight_alpha = true;
    file.notes = std::move(png.notes);
    return file;
}

ImageFile imageOfTiff(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    TiffImage tiff = readTiff(bytes, name, max);
    ImageFile file = ofOneLayer("TIFF", tiff.sample, std::move(tiff.image));
    file.display_referred = !tiff.linear;
    file.straight_alpha = !tiff.associated;
    file.notes = std::move(tiff.notes);
    return file;
}

std::span<const unsigned char> encodedJpeg(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()};
}

// Includes the decoded RGBA bytes, which exist at the same time.
ImageSize sizeOfJpeg(const JpegSize& size, EightBits eight) {
    const int components = size.grey ? 1 : 3;
    return {size.width, size.height,
            eight == EightBits::kept ? 4 + components : std::int64_t{sizeof(float)} * components + 4};
}

// Reads the pixel aspect of JFIF: width / height is vertical over horizontal density, for all units (ITU-T
// T.871, 10.1). Reads the ICC profile (ICC.1:2022, B.4), which may be split into several segments.
FileNotes notesOfJpeg(std::span<const std::byte> bytes) {
    using namespace std::string_view_literals;
    constexpr std::string_view jfif = "JFIF\0"sv, icc = "ICC_PROFILE\0"sv;
    FileNotes notes;
    std::string profile;
    visitJpeg(bytes, [&](const Chunk& segment) {
        if (segment.name == "\xe0" && segment.data.starts_with(jfif) && bigEndian(segment.data, 8, 2) > 0)
            noteAspect(static_cast<double>(bigEndian(segment.data, 10, 2)) / bigEndian(segment.data, 8, 2),
                       notes);
        constexpr std::size_t numbers = 2;  // sequence number and count
        if (segment.name == "\xe2" && segment.data.starts_with(icc) &&
            segment.data.size() > icc.size() + numbers)
            profile += segment.data.substr(icc.size() + numbers);
        return true;
    });
    if (!profile.empty()) noteProfile(profile, "sRGB", notes);
    return notes;
}

// The values of a JPEG without colour conversion: value / 255. It has no alpha.
ImageFile imageOfJpeg(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max,
                      EightBits eight) {
    return named(name, [&] {
        const std::span encoded = encodedJpeg(bytes);
        const JpegSize size = readJpegSize(encoded);
        checkImageSize(size.width, size.height, sizeOfJpeg(size, eight).bytes_per_pixel, max);
        if (size.width * size.height / jpeg_pixels_per_byte > static_cast<std::int64_t>(bytes.size()))
            failToHold(size.width, size.height, bytes.size());
        const int width = static_cast<int>(size.width), height = static_cast<int>(size.height);
        const std::size_t components = size.grey ? 1 : 3,
                          pixels = static_cast<std::size_t>(size.width * size.height);
        std::vector<unsigned char> rgba(4 * pixels);
        readJpegRgba(encoded, size, rgba.data());
        Image8 coded{width, height, static_cast<int>(components),
                     std::vector<std::uint8_t>(components * pixels)};
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(&rgba[4 * i], components, &coded.data[components * i]);
        rgba = {};
        StoredImage stored{{}, std::move(coded), static_cast<int>(components)};
        ImageFile file = eight == EightBits::kept ? ofOneLayer("JPEG", "8 bit", {}, std::move(stored.coded))
                                                  : ofOneLayer("JPEG", "8 bit", stored.takeImage());
        orient(file, orientationOfJpeg(bytes));
        file.notes = notesOfJpeg(bytes);
        file.display_referred = true;
        return file;
    });
}

ImageFile imageOfHdr(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    HdrImage hdr = readHdr(bytes, name, max);
    ImageFile file = ofOneLayer("Radiance HDR", "RGBE", std::move(hdr.image));
    file.notes = std::move(hdr.notes);
    return file;
}

ImageFile imageOfPfm(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    PfmImage pfm = readPfm(bytes, name, max);
    ImageFile file = ofOneLayer("PFM", "float", std::move(pfm.image));
    if (pfm.behind > 0)
        file.notes.in_part.push_back(
            fmt::format("{} after its pixels: ignored", counted(pfm.behind, "byte")));
    if (pfm.scale != 1)
        file.notes.lines.push_back(
            fmt::format("its values were multiplied by {}, the scale in its header", pfm.scale));
    return file;
}

// Formats, recognized by their first bytes.
enum class Format { exr, png, jpeg, tiff, hdr, pfm };

Format formatOf(std::span<const std::byte> bytes, const std::string& name, std::string_view part) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x76\x2f\x31\x01")) return Format::exr;
    const auto format = text.starts_with("\x89PNG\r\n\x1a\n")              ? std::optional(Format::png)
                        : text.starts_with("\xff\xd8\xff")                 ? std::optional(Format::jpeg)
                        : isTiff(bytes)                                    ? std::optional(Format::tiff)
                        : text.starts_with("#?")                           ? std::optional(Format::hdr)
                        : text.starts_with("PF") || text.starts_with("Pf") ? std::optional(Format::pfm)
                                                                           : std::nullopt;
    if (!format)
        throw std::runtime_error(
            name +
            ": is not a supported image; supported formats: OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PFM");
    if (!part.empty()) throw std::runtime_error(name + ": has no parts; only OpenEXR files have them");
    return *format;
}

ImageSize sizeOfExr(std::span<const std::byte> bytes, std::string_view part) {
    const ExrHeader header = readExrHeader(bytes, limits::imageBytes(), part);
    ImageSize size{header.display.width(), header.display.height(), 0};
    for (const ExrPart& one : header.parts)
        size.bytes_per_pixel += 4 * (std::ssize(one.channels) +
                                     std::ranges::count(one.channels, ExrSample::uint, &ExrChannel::sample));
    return size;
}

ImageFile readOf(Format format, std::span<const std::byte> bytes, const std::string& name,
                 std::string_view part, std::uint64_t max, EightBits eight) {
    switch (format) {
        case Format::exr:
            return readExr(bytes, name, max, part);
        case Format::png:
            return imageOfPng(bytes, name, max, eight);
        case Format::jpeg:
            return imageOfJpeg(bytes, name, max, eight);
        case Format::tiff:
            return imageOfTiff(bytes, name, max);
        case Format::hdr:
            return imageOfHdr(bytes, name, max);
        case Format::pfm:
            break;
    }
    return imageOfPfm(bytes, name, max);
}

}  // namespace

ImageFile readImage(std::span<const std::byte> bytes, const std::string& name, std::string_view part,
                    std::uint64_t max, EightBits eight) {
    const ImageSize size = imageSize(bytes, name, part, eight);
    Claim claim = named(name, [&] {
        return claimMemory(static_cast<std::uint64_t>(size.width * size.height * size.bytes_per_pixel),
                           bytes.size(), fmt::format("an image of {} x {} pixels", size.width, size.height));
    });
    ImageFile file = readOf(formatOf(bytes, name, part), bytes, name, part, max, eight);
    file.claim = std::move(claim);
    return file;
}

ImageSize imageSize(std::span<const std::byte> bytes, const std::string& name, std::string_view part,
                    EightBits eight) {
    const Format format = formatOf(bytes, name, part);
    return named(name, [&] {
        ImageSize size = format == Format::exr    ? sizeOfExr(bytes, part)
                         : format == Format::png  ? pngSize(bytes, eight)
                         : format == Format::jpeg ? sizeOfJpeg(readJpegSize(encodedJpeg(bytes)), eight)
                         : format == Format::tiff ? tiffSize(bytes)
                         : format == Format::hdr  ? hdrSize(bytes)
                                                  : pfmSize(bytes);
        checkImageSize(size.width, size.height, size.bytes_per_pixel, limits::imageBytes());
        const int orientation = format == Format::png    ? orientationOfPng(bytes)
                                : format == Format::jpeg ? orientationOfJpeg(bytes)
                                                         : 1;
        if (orientation != 1) size.bytes_per_pixel *= 2;  // reorientation needs a copy
        if (orientation >= 5) std::swap(size.width, size.height);
        return size;
    });
}

ImageName imageName(const std::filesystem::path& words) {
    constexpr std::string_view key = "?part=";
    const std::string text = words.string();
    const std::size_t at = text.rfind(key);
    std::error_code ignored;
    if (at == text.npos || std::filesystem::exists(words, ignored)) return {words};
    return {text.substr(0, at), text.substr(at + key.size())};
}

ImageFile readImage(const std::filesystem::path& file, std::string_view part) {
    const ImageName name = imageName(file);
    return readImage(std::as_bytes(std::span<const unsigned char>(bytesOf(name.file))), file.string(),
                     part.empty() ? name.part : part);
}

}  // namespace diptych
