// SPDX-License-Identifier: MIT
#include "shared/image/png_decoder.h"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>

namespace diptych {

PngDecoder::PngDecoder(std::span<const std::byte> file, Rows rows, const char* cutShort)
    : rest_(file), rows_(rows), cut_short_(cutShort) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, [](png_structp, png_const_charp) {});
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) {
        png_destroy_read_struct(&png_, nullptr, nullptr);
        throw std::bad_alloc();
    }
}

PngDecoder::~PngDecoder() {
    png_destroy_read_struct(&png_, &info_, nullptr);
}

void PngDecoder::readHeader() {
    if (!tryHeader()) throw std::runtime_error(message_.data());
}

void PngDecoder::readRow(png_bytep row) {
    if (!tryRow(row)) throw std::runtime_error(message_.data());
}

void PngDecoder::readAll(png_bytep rows) {
    const std::size_t lines = height(), bytes = rowBytes();
    for (int pass = 0; pass < passes_; ++pass)
        for (std::size_t y = 0; y < lines; ++y) readRow(rows + y * bytes);
}

// libpng reports errors by longjmp: no object with a destructor may be created between setjmp and here.
void PngDecoder::onError(png_structp png, png_const_charp message) {
    auto& self = *static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::strncpy(self.message_.data(), message, self.message_.size() - 1);
    png_longjmp(png, 1);
}

void PngDecoder::onRead(png_structp png, png_bytep out, std::size_t count) {
    auto& self = *static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (count > self.rest_.size()) png_error(png, self.cut_short_);
    std::memcpy(out, self.rest_.data(), count);
    self.rest_ = self.rest_.subspan(count);
}

bool PngDecoder::tryHeader() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, this, onRead);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png_, info_);
    png_set_expand(png_);  // palettes, fewer than 8 bits, tRNS
    if (rows_ == Rows::rgba) {
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
    }
    // Native byte order of 16-bit components.
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
}

bool PngDecoder::tryRow(png_bytep row) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_row(png_, row, nullptr);
    return true;
}

}  // namespace diptych
