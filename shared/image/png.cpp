// SPDX-License-Identifier: MIT
#include "shared/image/png.h"

#include "shared/image/atomic_file.h"

#include <fmt/format.h>
#include <png.h>

#include <zlib.h>

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace diptych {
namespace {

struct Failure {
    std::string message;
};

// libpng reports errors by longjmp: no object with a destructor may be created between setjmp and here.
void onError(png_structp png, png_const_charp message) {
    static_cast<Failure*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}
void onWarning(png_structp, png_const_charp) {}

// Names the program that wrote the file, so that it recognizes its own files. libpng needs char*.
char softwareKey[] = "Software", softwareName[] = "diptych";

// The colours of an image with at most 256 of them, in order of appearance, and each pixel's index.
struct Palette {
    std::vector<png_color> colors;
    std::vector<png_byte> indices;
};

// For RGB images; has no colours if there are too many.
Palette paletteOf(const Image8& image) {
    Palette palette;
    if (image.components != 3) return palette;
    const std::size_t pixels = image.data.size() / 3;
    std::unordered_map<std::uint32_t, png_byte> known_colors;
    palette.indices.resize(pixels);
    std::uint32_t last = ~0u;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* p = &image.data[3 * i];
        const std::uint32_t color = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
        if (color == last) {
            palette.indices[i] = palette.indices[i - 1];
            continue;
        }
        const auto [entry, isNew] =
            known_colors.try_emplace(color, static_cast<png_byte>(palette.colors.size()));
        if (isNew && palette.colors.size() == 256) return {};
        if (isNew) palette.colors.push_back({p[0], p[1], p[2]});
        palette.indices[i] = entry->second;
        last = color;
    }
    return palette;
}

// Level 4, because a report has dozens of images: level 6 takes twice as long and saves a thirtieth. A
// palette reduces error maps and masks to a third; other images use the Paeth filter.
bool encode(png_structp png, png_infop info, std::FILE* stream, const Image8& image, const Palette& palette) {
    if (setjmp(png_jmpbuf(png))) return false;
    const bool indexed = !palette.colors.empty();
    png_init_io(png, stream);
    png_set_compression_level(png, 4);
    if (!indexed) png_set_compression_strategy(png, Z_FILTERED);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, indexed ? PNG_FILTER_NONE : PNG_FILTER_PAETH);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 indexed                 ? PNG_COLOR_TYPE_PALETTE
                 : image.components == 4 ? PNG_COLOR_TYPE_RGBA
                                         : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (indexed) png_set_PLTE(png, info, palette.colors.data(), static_cast<int>(palette.colors.size()));
    png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = softwareKey;
    text.text = softwareName;
    text.text_length = sizeof softwareName - 1;
    png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    const std::uint8_t* const rows = indexed ? palette.indices.data() : image.data.data();
    const std::size_t row = static_cast<std::size_t>(image.width) *
                            (indexed ? std::size_t{1} : static_cast<std::size_t>(image.components));
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
        png_write_row(png, rows + y * row);
    png_write_end(png, info);
    return true;
}

// `name`: for messages. Returns false if writing failed.
bool writeTo(std::FILE* stream, const Image8& image, const std::string& name) {
    if (image.width < 1 || image.height < 1 || (image.components != 3 && image.components != 4) ||
        image.data.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                 static_cast<std::size_t>(image.components))
        throw std::runtime_error(
            fmt::format("{}: a PNG is not {}x{}x{}", name, image.width, image.height, image.components));
    const Palette palette = paletteOf(image);
    Failure failure;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
    if (!png) throw std::bad_alloc();
    png_infop info = png_create_info_struct(png);
    if (!info) failure.message = "out of memory";
    const bool written = info && encode(png, info, stream, image, palette);
    png_destroy_write_struct(&png, &info);
    if (written || std::ferror(stream)) return written;
    throw std::runtime_error(fmt::format("{}: {}", name, failure.message));
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image8& image) {
    AtomicFile out(file);
    writeTo(out.stream(), image, file.string());
    out.commit();  // throws with the system's message if writing failed
}

std::string pngBytes(const Image8& image) {
    char* bytes = nullptr;
    std::size_t size = 0;
    std::FILE* const stream = ::open_memstream(&bytes, &size);
    if (!stream) throw std::bad_alloc();
    const auto close = [&](std::FILE* open) {
        std::fclose(open);
        std::free(bytes);
    };
    const std::unique_ptr<std::FILE, decltype(close)> closed(stream, close);
    if (!writeTo(stream, image, "a picture") || std::fflush(stream) != 0) throw std::bad_alloc();
    return {bytes, size};
}

}  // namespace diptych
