// SPDX-License-Identifier: MIT
// Behaviour common to all readers of images and textures. A row for each kind of file.
#include "shared/image/image_file.h"
#include "shared/scene/image/decode.h"
#include "tests/support/campaign.h"
#include "tests/support/errors.h"
#include "tests/support/exr_builder.h"
#include "tests/support/jpeg_builder.h"
#include "tests/support/png_builder.h"
#include "tests/support/tiff_builder.h"
#include "tests/support/webp_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {
namespace {

using namespace std::string_literals;

enum class ReadAs { image, texture };
struct ReaderRow {
    const char* name;
    ReadAs as;
    std::string (*file)();
    int width, height;
    std::size_t unread = 0;  // bytes at the end that no pixel needs
};
void PrintTo(const ReaderRow& row, std::ostream* out) {
    *out << row.name;
}

std::string jpegText(const std::vector<unsigned char>& bytes) {
    return {bytes.begin(), bytes.end()};
}
std::string plainPng() {
    return pngOf(
        {PNG_COLOR_TYPE_RGB_ALPHA, 8, 2, {std::vector<std::uint8_t>(8, 9), {1, 2, 3, 4, 5, 6, 7, 8}}});
}
std::string deepPng() {
    const std::vector<std::uint8_t> row(12, 7);
    return pngOf({PNG_COLOR_TYPE_RGB, 16, 2, {row, row}, true});
}
std::string palettePng() {
    MadePng png{PNG_COLOR_TYPE_PALETTE, 2, 3, {{0x18}, {0x24}}, true};
    png.palette = {{255, 0, 51}, {102, 204, 0}, {0, 0, 0}};
    png.palette_alpha = {51};
    return pngOf(png);
}
std::string colorJpeg() {
    return jpegText(jpeg(JCS_RGB, JCS_YCbCr, {200, 100, 50}));
}
std::string progressiveJpeg() {
    return jpegText(jpeg(JCS_RGB, JCS_YCbCr, {200, 100, 50}, true));
}
std::string inkJpeg() {
    return jpegText(jpeg(JCS_CMYK, JCS_YCCK, {200, 100, 50, 9}, true));
}

// IEND, and the checksum before it.
constexpr std::size_t png_end = 12 + 4;

const ReaderRow readerRows[] = {
    {"exr_lines", ReadAs::image,
     [] {
         return exrOf({{"", {{"R", Imf::HALF}, {"G", Imf::FLOAT}, {"B", Imf::UINT}}}});
     },
     9, 6},
    {"exr_tiles_of_two_parts", ReadAs::image,
     [] {
         MadePart a{"a", {{"R", Imf::HALF}}}, b{"b", {{"Z", Imf::FLOAT}}};
         b.tile = 4;
         return exrOf({a, b});
     },
     9, 6},
    {"png", ReadAs::image, plainPng, 2, 2, png_end},
    {"png_interlaced", ReadAs::image, deepPng, 2, 2, png_end},
    {"png_palette", ReadAs::image, palettePng, 3, 2, png_end},
    {"jpeg", ReadAs::image, colorJpeg, 16, 16},
    {"jpeg_progressive", ReadAs::image, progressiveJpeg, 16, 16},
    {"jpeg_inks", ReadAs::image, inkJpeg, 16, 16},
    {"tiff", ReadAs::image, [] { return madeTiff(3, 2, 3, 16, 1, std::string(36, 'y')).bytes(); }, 3, 2},
    {"hdr", ReadAs::image,
     [] { return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x09\x09\x09\x81"s; }, 2,
     1},
    {"hdr_runs", ReadAs::image,
     [] {
         return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n"
                "\x02\x02\x00\x08\x88\xc8\x08\x01\x02\x03\x04\x05\x06\x07\x08\x83\x05\x85\x06\x88\x80"s;
     },
     8, 1},
    {"pfm", ReadAs::image, [] { return "PF\n1 2\n-1.0\n" + std::string(24, '\x3f'); }, 1, 2},
    {"png_texture", ReadAs::texture, plainPng, 2, 2, png_end},
    {"png_interlaced_texture", ReadAs::texture, deepPng, 2, 2, png_end},
    {"png_palette_texture", ReadAs::texture, palettePng, 3, 2, png_end},
    {"jpeg_texture", ReadAs::texture, colorJpeg, 16, 16},
    {"jpeg_progressive_texture", ReadAs::texture, progressiveJpeg, 16, 16},
    {"jpeg_inks_texture", ReadAs::texture, inkJpeg, 16, 16},
    {"webp_lossless", ReadAs::texture, [] { return losslessWebp(colourfulWebp(9, 7, false)); }, 9, 7},
    {"webp_one_colour", ReadAs::texture,
     [] {
         return losslessWebp(plainWebp(9, 7, {1, 2, 3, 255}));
     },
     9, 7},
    {"webp_lossy", ReadAs::texture, [] { return lossyWebp(colourfulWebp(37, 21, true)); }, 37, 21},
    {"webp_alpha", ReadAs::texture, [] { return lossyWebp(colourfulWebp(37, 21, false)); }, 37, 21},
};

struct ReadSize {
    int width, height;
};

class EveryReader : public testing::TestWithParam<ReaderRow> {
protected:
    // Reads the bytes and checks that the pixels are as many as the size says.
    ReadSize read(std::string_view bytes) const {
        if (row_.as == ReadAs::texture) {
            const TextureImage image =
                decodeImage({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
            EXPECT_EQ(image.rgba.size() + image.rgba16.size(), std::size_t{4} *
                                                                   static_cast<std::size_t>(image.width) *
                                                                   static_cast<std::size_t>(image.height));
            return {image.width, image.height};
        }
        const std::span raw = std::as_bytes(std::span(bytes));
        const ImageFile file = readImage(raw, "a", {}, 1 << 20);
        const ImageSize size = imageSize(raw, "a");
        EXPECT_EQ(size.width, file.width) << "as the header says";
        EXPECT_EQ(size.height, file.height);
        for (const ImageLayer& layer : file.layers) {
            EXPECT_EQ(layer.image.width, file.width);
            EXPECT_EQ(layer.image.height, file.height);
            EXPECT_EQ(layer.image.data.size(), layer.image.pixels() * layer.channels.size());
        }
        return {file.width, file.height};
    }
    // One line that names the file; empty if it is read.
    std::string fault(std::string_view bytes) const {
        const std::string why = faultOf([&] { read(bytes); });
        EXPECT_EQ(why.find('\n'), std::string::npos) << why;
        EXPECT_TRUE(why.empty() || row_.as == ReadAs::texture || why.starts_with("a: ")) << why;
        return why;
    }

    const ReaderRow& row_ = GetParam();
    const std::string whole_ = row_.file();
};

TEST_P(EveryReader, ReadsTheSizeOfTheHeader) {
    const ReadSize size = read(whole_);
    EXPECT_EQ(size.width, row_.width);
    EXPECT_EQ(size.height, row_.height);
}

// At every byte of the first 4 kB, and at 64 places beyond.
TEST_P(EveryReader, RefusesATruncatedFile) {
    constexpr std::size_t every = 4096, beyond = 64;
    const std::size_t needed = whole_.size() - row_.unread;
    std::vector<std::size_t> lengths;
    for (std::size_t size = 0; size < std::min(needed, every); ++size) lengths.push_back(size);
    std::mt19937 random(1);
    for (std::size_t i = 0; needed > every && i < beyond; ++i)
        lengths.push_back(every + random() % (needed - every));
    testing::internal::CaptureStderr();
    for (const std::size_t size : lengths) {
        const std::string why = fault(std::string_view(whole_).substr(0, size));
        EXPECT_NE(why, "") << size << " of " << whole_.size();
        if (std::string_view(row_.name).starts_with("webp")) {
            EXPECT_TRUE(why.starts_with(size < 12 ? "is not PNG, JPEG or WebP" : "does not decode: "))
                << size << ": " << why;
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(fault(whole_), "");
}

// It is read as an image of the header's size, or refused in one line.
TEST_P(EveryReader, TakesAnyByteThatIsWrong) {
    testing::internal::CaptureStderr();
    const Rows rows(3);
    for (int row = 0; row < 3 * static_cast<int>(std::min(whole_.size(), std::size_t{2048}));
         row = rows.after(row)) {
        const auto at = static_cast<std::size_t>(row / 3);
        std::string changed = whole_;
        changed[at] = static_cast<char>(changed[at] ^ std::array{0x01, 0x80, 0xff}[(row + at) % 3]);
        fault(changed);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(Row, EveryReader, testing::ValuesIn(readerRows),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace diptych
