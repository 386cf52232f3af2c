// SPDX-License-Identifier: MIT
// libpng as this program reads files with it, pictures and textures alike. Only shared/image/png* sees
// libpng.
#pragma once

#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych {

// A file's rows, from top to bottom. Chunks other than IHDR, PLTE, tRNS, IDAT and IEND are stepped over: no
// profile, no text is unpacked. What throws, throws std::runtime_error with libpng's words, without a name,
// or std::bad_alloc.
class PngDecoder {
public:
    // What a row holds: palettes are looked up, fewer than 8 bits become 8, and tRNS an alpha, in both.
    enum class Rows {
        as_stored,  // Y, YA, RGB or RGBA
        rgba,       // opaque where the file says nothing of it
    };

    // `cutShort` is the error where the file ends early. Both stay the caller's.
    PngDecoder(std::span<const std::byte> file, Rows rows, const char* cutShort);
    ~PngDecoder();
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    // First of all; what follows is of its rows.
    void readHeader();

    std::uint32_t width() const { return png_get_image_width(png_, info_); }
    std::uint32_t height() const { return png_get_image_height(png_, info_); }
    int components() const { return png_get_channels(png_, info_); }
    int bits() const { return png_get_bit_depth(png_, info_); }  // 8 or 16, in the machine's order
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
    bool isInterlaced() const { return passes_ > 1; }

    // The next row. Not of interlaced files, of which no row is whole before all are.
    void readRow(png_bytep row);
    // All of them, one after the other, into room for height() * rowBytes().
    void readAll(png_bytep rows);

private:
    [[noreturn]] static void onError(png_structp png, png_const_charp message);
    static void onRead(png_structp png, png_bytep out, std::size_t count);
    bool tryHeader();
    bool tryRow(png_bytep row);

    std::span<const std::byte> rest_;
    Rows rows_;
    const char* cut_short_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
    std::array<char, 200> message_{};  // of the error; what is thrown is made outside of libpng
};

}  // namespace diptych
