// SPDX-License-Identifier: MIT
#include "shared/image/jpeg_decoder.h"

#include <cstdio>  // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

using Bytes = std::span<const unsigned char>;

// Each scan of a progressive file visits all pixels, although a scan may take only a few bytes. So the sum
// of pixels over all scans is limited, to 16 scans of the largest image. Encoders write about ten scans.
constexpr std::int64_t maxScannedPixels = std::int64_t{16} << 28;

// libjpeg reports errors by longjmp: no object with a destructor may be created between setjmp and here.
struct Errors {
    jpeg_error_mgr manager;  // must be first: libjpeg returns a pointer to it, which is cast to Errors
    std::jmp_buf out;
    std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] void giveUp(j_common_ptr jpeg) {
    auto& errors = *reinterpret_cast<Errors*>(jpeg->err);
    (*jpeg->err->format_message)(jpeg, errors.message.data());
    std::longjmp(errors.out, 1);
}

// libjpeg only warns if pixels are lost, and fills them with grey; here that is an error. Other warnings
// do not lose pixels.
void onMessage(j_common_ptr jpeg, int level) {
    if (level >= 0) return;
    switch (jpeg->err->msg_code) {
        case JWRN_ADOBE_XFORM:
        case JWRN_EXTRANEOUS_DATA:
        case JWRN_JFIF_MAJOR:
        case JWRN_TOO_MUCH_DATA:
            return;
        default:
            giveUp(jpeg);
    }
}

void onOutput(j_common_ptr) {}

void onProgress(j_common_ptr common) {
    const auto& jpeg = *reinterpret_cast<j_decompress_ptr>(common);
    const std::int64_t pixels = std::int64_t{jpeg.image_width} * std::int64_t{jpeg.image_height};
    if (std::max<std::int64_t>(pixels, 1 << 20) * jpeg.input_scan_number <= maxScannedPixels) return;
    auto& errors = *reinterpret_cast<Errors*>(common->err);
    std::snprintf(errors.message.data(), errors.message.size(), "it has at least %d scans",
                  jpeg.input_scan_number);
    std::longjmp(errors.out, 1);
}

// RAII for a decompressor. It must be created before setjmp is called.
class Decompressor {
public:
    explicit Decompressor(Bytes encoded) {
        jpeg.err = jpeg_std_error(&errors.manager);
        errors.manager.error_exit = giveUp;
        errors.manager.emit_message = onMessage;
        errors.manager.output_message = onOutput;
        encoded_ = encoded;
    }
    ~Decompressor() { jpeg_destroy_decompress(&jpeg); }
    Decompressor(const Decompressor&) = delete;
    Decompressor& operator=(const Decompressor&) = delete;

    // Reads up to the first scan; may longjmp.
    void begin() {
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, encoded_.data(), static_cast<unsigned long>(encoded_.size()));
        progress_.progress_monitor = onProgress;
        jpeg.progress = &progress_;
        jpeg_read_header(&jpeg, TRUE);
    }

    Errors errors{};
    jpeg_decompress_struct jpeg{};

private:
    Bytes encoded_;
    jpeg_progress_mgr progress_{};
};

bool isFourColour(const jpeg_decompress_struct& jpeg) {
    return jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
}

bool readHeader(Decompressor& d) {
    if (setjmp(d.errors.out)) return false;
    d.begin();
    return true;
}

// CMYK to RGBA, in place. Adobe's files store inverted inks (`inverted`): 255 is no ink.
void rgbaFromInks(unsigned char* row, std::size_t pixels, bool inverted) {
    for (unsigned char* p = row; p < row + 4 * pixels; p += 4) {
        const int black = inverted ? p[3] : 255 - p[3];
        for (int c = 0; c < 3; ++c) {
            const int ink = inverted ? p[c] : 255 - p[c];
            p[c] = static_cast<unsigned char>((ink * black + 127) / 255);
        }
        p[3] = 255;
    }
}

bool decode(Decompressor& d, const JpegSize& size, unsigned char* pixels) {
    if (setjmp(d.errors.out)) return false;
    d.begin();
    const bool inks = isFourColour(d.jpeg);
    d.jpeg.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(&d.jpeg);
    if (d.jpeg.output_width != size.width || d.jpeg.output_height != size.height)
        ERREXIT(&d.jpeg, JERR_IMAGE_TOO_BIG);
    const std::size_t row = 4 * static_cast<std::size_t>(size.width);
    while (d.jpeg.output_scanline < d.jpeg.output_height) {
        unsigned char* line = pixels + d.jpeg.output_scanline * row;
        jpeg_read_scanlines(&d.jpeg, &line, 1);
        if (inks) rgbaFromInks(line, d.jpeg.output_width, d.jpeg.saw_Adobe_marker != 0);
    }
    return true;
}

[[noreturn]] void failDecoding(const Decompressor& d) {
    throw std::runtime_error(std::string("does not decode: ") + d.errors.message.data());
}

}  // namespace

JpegSize readJpegSize(Bytes encoded) {
    Decompressor d(encoded);
    if (!readHeader(d)) failDecoding(d);
    if (d.jpeg.arith_code)
        throw std::runtime_error("is a JPEG with arithmetic coding, which is not supported");
    if (d.jpeg.jpeg_color_space == JCS_UNKNOWN)
        throw std::runtime_error(
            "is a JPEG with an unsupported colour space; supported: grey, RGB, YCbCr, CMYK, YCCK");
    return {d.jpeg.image_width, d.jpeg.image_height, d.jpeg.jpeg_color_space == JCS_GRAYSCALE};
}

void readJpegRgba(Bytes encoded, const JpegSize& size, unsigned char* pixels) {
    Decompressor d(encoded);
    if (!decode(d, size, pixels)) failDecoding(d);
}

}  // namespace diptych
