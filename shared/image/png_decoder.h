// SPDX-License-Identifier: MIT
// Reads PNG files by libpng, for images and textures. Only shared/image/png* includes libpng.
#pragma once

#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych {

// Decodes a file's rows, from top to bottom. Skips chunks other than IHDR, PLTE, tRNS, IDAT and IEND, so
// no profile or text is decompressed. Throws std::runtime_error with libpng's message, without the file's
// name, or std::bad_alloc.
class PngDecoder {
public:
    // Format of the decoded rows. In both, palettes are expanded, fewer than 8 bits become 8, and tRNS
    // becomes alpha.
    enum class Rows {
        as_stored,  // Y, YA, RGB or RGBA
        rgba,       // opaque if the file has no transparency
    };

    // `cutShort`: error message for truncated files. `file` and `cutShort` must outlive the decoder.
    PngDecoder(std::span<const std::byte> file, Rows rows, const char* cutShort);
    ~PngDecoder();
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    // Must be called before all other functions.
    void readHeader();

    std::uint32_t width() const { return png_get_image_width(png_, info_); }
    std::uint32_t height() const { return png_get_image_height(png_, info_); }
    int components() const { return png_get_channels(png_, info_); }
    int bits() const { return png_get_bit_depth(png_, info_); }  // 8, or 16 in native byte order
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
    bool isInterlaced() const { return passes_ > 1; }

    // Reads the next row. Not for interlaced files, whose rows are complete only at the end.
    void readRow(png_bytep row);
    // Reads all rows into height() * rowBytes() bytes.
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
    std::array<char, 200> message_{};  // of an error; the exception is thrown outside libpng
};

}  // namespace diptych
