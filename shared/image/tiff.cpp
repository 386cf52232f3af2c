// SPDX-License-Identifier: MIT
#include "shared/image/tiff.h"

#include "shared/image/claims.h"
#include "shared/image/orientation.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <Imath/half.h>
#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

namespace diptych {
namespace {

// A file in memory for libtiff, and its first error message.
struct TiffBytes {
    std::span<const std::byte> bytes;
    std::uint64_t at = 0;
    std::string error{};
};

TiffBytes& tiffBytes(thandle_t handle) {
    return *static_cast<TiffBytes*>(handle);
}

tmsize_t readTiffBytes(thandle_t handle, void* to, tmsize_t wanted) {
    TiffBytes& file = tiffBytes(handle);
    const std::uint64_t left = file.at < file.bytes.size() ? file.bytes.size() - file.at : 0;
    const std::uint64_t count = std::min(left, static_cast<std::uint64_t>(std::max<tmsize_t>(wanted, 0)));
    if (count > 0) std::memcpy(to, file.bytes.data() + file.at, count);
    file.at += count;
    return static_cast<tmsize_t>(count);
}

toff_t seekTiffBytes(thandle_t handle, toff_t to, int from) {
    TiffBytes& file = tiffBytes(handle);
    file.at = from == SEEK_SET ? to : from == SEEK_CUR ? file.at + to : file.bytes.size() + to;
    return file.at;
}

int keepError(TIFF*, void* user, const char*, const char* format, va_list arguments) {
    TiffBytes& file = tiffBytes(user);
    if (!file.error.empty()) return 1;
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    file.error = oneLine(text);
    return 1;
}

int ignoreWarning(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

// libtiff allocates no block larger than `max`, whatever the file claims.
OpenTiff openTiff(TiffBytes& file, std::uint64_t max) {
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                   TIFFOpenOptionsFree);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(),
                                        static_cast<tmsize_t>(std::min<std::uint64_t>(max, 1ull << 40)));
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepError, &file);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreWarning, nullptr);
    // "m": no memory mapping, because the file is already in memory.
    return OpenTiff(
        TIFFClientOpenExt(
            "", "rm", &file, readTiffBytes, [](thandle_t, void*, tmsize_t) -> tmsize_t { return 0; },
            seekTiffBytes, [](thandle_t) { return 0; },
            [](thandle_t handle) -> toff_t { return tiffBytes(handle).bytes.size(); }, nullptr, nullptr,
            options.get()),
        TIFFClose);
}

template <class T>
T tagOf(TIFF* tiff, std::uint32_t tag, T otherwise) {
    T value = otherwise;
    return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

// Properties of the image from its directory.
struct TiffLayout {
    std::uint32_t width = 0, height = 0;
    std::uint16_t components = 1, bits = 1, format = SAMPLEFORMAT_UINT, colours = 0, compression = 0;
    std::uint16_t orientation = ORIENTATION_TOPLEFT;  // libtiff returns only 1 to 8
    bool planes = false, tiled = false;

    std::size_t bytesPerSample() const { return bits / 8u; }
};

// Largest expansion of one byte of the file; 0: unsupported. LZW: a code of 9 to 12 bits gives at most
// 4096 bytes. PackBits: two bytes give 128.
std::uint64_t ratioOf(std::uint16_t compression) {
    switch (compression) {
        case COMPRESSION_NONE:
            return 1;
        case COMPRESSION_PACKBITS:
            return 64;
        case COMPRESSION_LZW:
            return 4096;
        case COMPRESSION_DEFLATE:
        case COMPRESSION_ADOBE_DEFLATE:
            return limits::deflate_ratio;
        default:
            return 0;
    }
}

bool isFloat(const TiffLayout& layout) {
    return layout.format == SAMPLEFORMAT_IEEEFP;
}

bool isInverted(const TiffLayout& layout) {
    return layout.colours == PHOTOMETRIC_MINISWHITE && !isFloat(layout);
}

std::string sampleOf(const TiffLayout& layout) {
    if (isFloat(layout)) return layout.bits == 16 ? "half" : "float";
    return fmt::format("{} bit", layout.bits);
}

TiffLayout layoutOf(TIFF* tiff, std::size_t fileBytes, std::uint64_t max) {
    TiffLayout layout;
    layout.width = tagOf<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
    layout.height = tagOf<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
    layout.components = tagOf<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    layout.bits = tagOf<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
    layout.format = tagOf<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    layout.compression = tagOf<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    layout.orientation = tagOf<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    layout.planes =
        layout.components > 1 &&
        tagOf<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
    layout.tiled = TIFFIsTiled(tiff) != 0;
    if (TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &layout.colours) != 1)
        layout.colours = layout.components < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB;

    const bool grey = layout.colours == PHOTOMETRIC_MINISBLACK || layout.colours == PHOTOMETRIC_MINISWHITE;
    if (!grey && layout.colours != PHOTOMETRIC_RGB)
        fail(fmt::format("is a TIFF with photometric interpretation {}; supported: grey (0, 1) and RGB (2)",
                         layout.colours));
    const int colours = grey ? 1 : 3;
    if (layout.components < colours || layout.components > colours + 1)
        fail(fmt::format("is a TIFF with {} samples per pixel; supported: {} and one of alpha",
                         layout.components, grey ? "1 of grey" : "3 of RGB"));
    const bool read = isFloat(layout) ? layout.bits == 16 || layout.bits == 32
                                      : layout.format == SAMPLEFORMAT_UINT &&
                                            (layout.bits == 8 || layout.bits == 16 || layout.bits == 32);
    if (!read)
        fail(
            fmt::format("is a TIFF with {}-bit samples of format {}; supported: unsigned integers (1) of 8, "
                        "16 and 32 bits, floats (3) of 16 and 32 bits",
                        layout.bits, layout.format));
    const std::uint64_t ratio = ratioOf(layout.compression);
    if (ratio == 0)
        fail(
            fmt::format("is a TIFF with compression {}; supported: none (1), LZW (5), Deflate (8, 32946), "
                        "PackBits (32773)",
                        layout.compression));
    checkImageSize(layout.width, layout.height, static_cast<std::int64_t>(sizeof(float)) * layout.components,
                   max);
    const std::uint64_t stored =
        std::uint64_t{layout.width} * layout.height * layout.components * layout.bytesPerSample();
    if (stored / ratio > fileBytes) failToHold(layout.width, layout.height, fileBytes);
    return layout;
}

// `inverted`: 0 is white. Integers are inverted before the division, so that the result is rounded once.
float valueOf(const TiffLayout& layout, const unsigned char* sample, bool inverted) {
    const std::uint32_t flipped = inverted ? 0xffffffffu : 0;
    const auto as = [&]<class T>(T value) {
        std::memcpy(&value, sample, sizeof value);
        return value;
    };
    switch (layout.bits) {
        case 8:
            return static_cast<float>(static_cast<std::uint8_t>(*sample ^ flipped)) / 255.0f;
        case 16: {
            const auto code = static_cast<std::uint16_t>(as(std::uint16_t{}) ^ flipped);
            if (!isFloat(layout)) return static_cast<float>(code) / 65535.0f;
            Imath::half half;
            half.setBits(code);
            return half;
        }
        default:
            return isFloat(layout) ? as(0.0f)
                                   : static_cast<float>((as(std::uint32_t{}) ^ flipped) / 4294967295.0);
    }
}

// Decodes strips or tiles by libtiff and copies them into the image.
class Pieces {
public:
    Pieces(TIFF* tiff, const TiffLayout& layout, Image& image) : tiff_(tiff), layout_(layout), image_(image) {
        width_ = layout.tiled ? tagOf<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0) : layout.width;
        height_ = layout.tiled ? tagOf<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0)
                               : std::min(tagOf<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, layout.height),
                                          layout.height);
        samples_ = layout.planes ? 1 : layout.components;
    }

    // Returns whether all could be read from a file of `held` bytes; each may take `max` bytes.
    bool read(std::uint64_t max, std::uint64_t held) {
        if (width_ < 1 || height_ < 1 || width_ > limits::image_side || height_ > limits::image_side)
            return false;
        const std::uint64_t size = std::uint64_t{width_} * height_ * samples_ * layout_.bytesPerSample();
        const tmsize_t expected = layout_.tiled ? TIFFTileSize(tiff_) : TIFFStripSize(tiff_);
        if (size > max || expected < 0 || static_cast<std::uint64_t>(expected) != size) return false;
        // libtiff's own buffer, and ours.
        const Claim claim =
            claimMemory(2 * size, held, fmt::format("a tile or strip of {} x {} pixels", width_, height_));
        std::vector<unsigned char> piece(size);
        std::uint32_t index = 0;
        for (int plane = 0; plane < (layout_.planes ? layout_.components : 1); ++plane)
            for (std::uint32_t y = 0; y < layout_.height; y += height_)
                for (std::uint32_t x = 0; x < layout_.width; x += width_, ++index) {
                    const auto wanted = static_cast<tmsize_t>(
                        layout_.tiled ? size : size / height_ * std::min(height_, layout_.height - y));
                    const tmsize_t got = layout_.tiled
                                             ? TIFFReadEncodedTile(tiff_, index, piece.data(), wanted)
                                             : TIFFReadEncodedStrip(tiff_, index, piece.data(), wanted);
                    if (got != wanted) return false;
                    put(piece.data(), x, y, plane);
                }
        return true;
    }

private:
    void put(const unsigned char* from, std::uint32_t x0, std::uint32_t y0, int plane) {
        const bool inverted = isInverted(layout_);
        const std::size_t step = layout_.bytesPerSample();
        for (std::uint32_t y = y0; y < std::min(y0 + height_, layout_.height); ++y)
            for (std::uint32_t x = x0; x < std::min(x0 + width_, layout_.width); ++x)
                for (std::uint32_t s = 0; s < samples_; ++s) {
                    const std::size_t pixel = std::size_t{y - y0} * width_ + (x - x0);
                    const int component = layout_.planes ? plane : static_cast<int>(s);
                    image_.at(static_cast<int>(x), static_cast<int>(y), component) =
                        valueOf(layout_, from + (pixel * samples_ + s) * step, inverted && component == 0);
                }
    }

    TIFF* tiff_;
    const TiffLayout& layout_;
    Image& image_;
    std::uint32_t width_ = 0, height_ = 0, samples_ = 1;  // of a strip or tile
};

}  // namespace

bool isTiff(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                std::min<std::size_t>(bytes.size(), 4));
    using namespace std::string_view_literals;
    return text == "II*\0"sv || text == "MM\0*"sv || text == "II+\0"sv || text == "MM\0+"sv;
}

namespace {

[[noreturn]] void failToDecode(const TiffBytes& file) {
    fail("is a TIFF that does not decode: " +
         (file.error.empty() ? "its strips or tiles have no offsets" : file.error));
}

// Reads profile, primaries (TIFF 6.0, 20), resolution and the number of pages. Without a white point,
// primaries use D65.
void describe(TIFF* tiff, TiffImage& image) {
    std::uint32_t size = 0;
    void* profile = nullptr;
    const float *primaries = nullptr, *white = nullptr;
    const bool coloured = image.image.components >= 3;
    if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &size, &profile) == 1) {
        noteProfile({static_cast<const char*>(profile), size}, image.linear ? "linear" : "sRGB", image.notes);
    } else if (coloured && TIFFGetField(tiff, TIFFTAG_PRIMARYCHROMATICITIES, &primaries) == 1) {
        Primaries all{0, 0, 0, 0, 0, 0, 0.3127, 0.3290};
        std::copy_n(primaries, 6, all.begin());
        if (TIFFGetField(tiff, TIFFTAG_WHITEPOINT, &white) == 1) std::copy_n(white, 2, all.begin() + 6);
        if (const auto matrix = matrixToRec709(all, image.notes))
            convertColors(image.image, *matrix, !image.linear);
    }
    const auto across = tagOf<float>(tiff, TIFFTAG_XRESOLUTION, 0),
               up = tagOf<float>(tiff, TIFFTAG_YRESOLUTION, 0);
    if (across > 0 && up > 0) noteAspect(double{up} / across, image.notes);
    if (TIFFLastDirectory(tiff) == 0) image.notes.in_part.emplace_back("only its first page is read");
}

}  // namespace

ImageSize tiffSize(std::span<const std::byte> bytes) {
    TiffBytes file{bytes};
    const OpenTiff tiff = openTiff(file, limits::imageBytes());
    if (!tiff) failToDecode(file);
    const TiffLayout layout = layoutOf(tiff.get(), bytes.size(), limits::imageBytes());
    ImageSize size{layout.width, layout.height, static_cast<std::int64_t>(sizeof(float)) * layout.components};
    // Reorientation needs a copy.
    if (layout.orientation != ORIENTATION_TOPLEFT) size.bytes_per_pixel *= 2;
    if (layout.orientation >= ORIENTATION_LEFTTOP) std::swap(size.width, size.height);
    return size;
}

TiffImage readTiff(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    return named(name, [&] {
        TiffBytes file{bytes};
        const OpenTiff tiff = openTiff(file, max);
        if (!tiff) failToDecode(file);
        const TiffLayout layout = layoutOf(tiff.get(), bytes.size(), max);
        TiffImage image;
        image.image =
            Image(static_cast<int>(layout.width), static_cast<int>(layout.height), layout.components);
        image.sample = sampleOf(layout);
        image.linear = isFloat(layout);
        std::uint16_t extra = 0;
        const std::uint16_t* kinds = nullptr;
        image.associated = TIFFGetField(tiff.get(), TIFFTAG_EXTRASAMPLES, &extra, &kinds) == 1 && extra > 0 &&
                           kinds[0] == EXTRASAMPLE_ASSOCALPHA;
        if (!Pieces(tiff.get(), layout, image.image).read(max, bytes.size())) failToDecode(file);
        image.image = oriented(std::move(image.image), layout.orientation);
        describe(tiff.get(), image);
        if (isInverted(layout)) image.notes.lines.emplace_back("its values are inverted: 0 is white in it");
        return image;
    });
}

}  // namespace diptych
