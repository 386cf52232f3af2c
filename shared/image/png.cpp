// SPDX-License-Identifier: MIT
#include "shared/image/png.h"

#include "shared/image/atomic_file.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <new>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

struct Failure {
    std::string message;
};

// libpng leaves by longjmp on an error: no object with a destructor may be created between setjmp and here.
void onError(png_structp png, png_const_charp message) {
    static_cast<Failure*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}
void onWarning(png_structp, png_const_charp) {}

// Names the program that wrote the file, so that the tool recognises its own files. libpng needs char*.
char softwareKey[] = "Software", softwareName[] = "diptych";

// Optimised for speed, since a report has dozens of pictures: level 1 with the one filter that suits smooth
// shading takes a third of the time that libpng needs to choose among all filters, and files are no larger.
bool encode(png_structp png, png_infop info, std::FILE* stream, const Image8& image) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, stream);
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 image.components == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = softwareKey;
    text.text = softwareName;
    text.text_length = sizeof softwareName - 1;
    png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    const std::size_t row =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.components);
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
        png_write_row(png, image.data.data() + y * row);
    png_write_end(png, info);
    return true;
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image8& image) {
    if (image.width < 1 || image.height < 1 || (image.components != 3 && image.components != 4) ||
        image.data.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                 static_cast<std::size_t>(image.components))
        throw std::runtime_error(fmt::format("{}: a PNG is not {}x{}x{}", file.string(), image.width,
                                             image.height, image.components));
    AtomicFile out(file);
    Failure failure;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
    if (!png) throw std::bad_alloc();
    png_infop info = png_create_info_struct(png);
    if (!info) failure.message = "out of memory";
    const bool written = info && encode(png, info, out.stream(), image);
    png_destroy_write_struct(&png, &info);
    if (!written && std::ferror(out.stream())) out.commit();  // throws with the system's message
    if (!written) throw std::runtime_error(fmt::format("{}: {}", file.string(), failure.message));
    out.commit();
}

}  // namespace diptych
