// SPDX-License-Identifier: MIT
#include "shared/image/limits.h"
#include "shared/scene/image/codecs.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>

namespace diptych::codec {

namespace {

struct Source {
    Bytes rest;
    std::array<char, 200> message{};  // of the error; what is thrown is made outside of libpng
};

// libpng's way out of an error is a longjmp: nothing between setjmp and here may own anything.
[[noreturn]] void onError(png_structp png, png_const_charp message) {
    auto& source = *static_cast<Source*>(png_get_error_ptr(png));
    std::strncpy(source.message.data(), message, source.message.size() - 1);
    png_longjmp(png, 1);
}
void onWarning(png_structp, png_const_charp) {}

void readFromSource(png_structp png, png_bytep out, std::size_t count) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (count > source.rest.size()) png_error(png, "it ends early");
    std::copy_n(source.rest.begin(), count, out);
    source.rest = source.rest.subspan(count);
}

bool decode(png_structp png, png_infop info, Source& source, const ImageHeader& header, png_bytep pixels) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, &source, readFromSource);
    // Chunks other than IHDR, PLTE, tRNS, IDAT and IEND are stepped over: no profile, no text is unpacked.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_user_limits(png, static_cast<png_uint_32>(header.width), static_cast<png_uint_32>(header.height));
    png_read_info(png, info);
    png_set_expand(png);  // palettes, fewer than 8 bits, tRNS
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    if (header.deep && std::endian::native == std::endian::little) png_set_swap(png);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const std::size_t row = static_cast<std::size_t>(header.width) * (header.deep ? 8 : 4);
    if (png_get_rowbytes(png, info) != row || png_get_image_height(png, info) != header.height)
        png_error(png, "its header changes");
    for (int pass = 0; pass < passes; ++pass)
        for (std::size_t y = 0; y < static_cast<std::size_t>(header.height); ++y)
            png_read_row(png, pixels + y * row, nullptr);
    return true;
}

}  // namespace

// PNG specification (ISO/IEC 15948), 11.2.2: IHDR is the first chunk.
ImageHeader readPngHeader(Bytes encoded) {
    constexpr std::array<unsigned char, 8> ihdr{0, 0, 0, 13, 'I', 'H', 'D', 'R'};
    if (encoded.size() < 33 || !std::equal(ihdr.begin(), ihdr.end(), encoded.begin() + 8))
        failDecoding("it does not begin with a header");
    const auto word = [&](std::size_t at) {
        return std::int64_t{encoded[at]} << 24 | std::int64_t{encoded[at + 1]} << 16 |
               std::int64_t{encoded[at + 2]} << 8 | std::int64_t{encoded[at + 3]};
    };
    const int depth = encoded[24], color = encoded[25];  // libpng checks both
    const int bits = std::max(depth, 1) * (color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1);
    return {ImageHeader::Kind::png, word(16), word(20), depth == 16, 8 * limits::deflate_ratio / bits};
}

void decodePng(Bytes encoded, const ImageHeader& header, unsigned char* pixels) {
    Source source{encoded};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning);
    if (!png) throw std::bad_alloc();
    png_infop info = png_create_info_struct(png);
    const bool decoded = info && decode(png, info, source, header, pixels);
    png_destroy_read_struct(&png, &info, nullptr);
    if (!decoded) failDecoding(source.message.data());
}

}  // namespace diptych::codec
