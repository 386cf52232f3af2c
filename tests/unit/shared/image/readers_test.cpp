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

#include <algorithm>
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
// Codes are read as fractions of the largest.
enum class Stored { coded, linear };
struct ReaderRow {
    const char* name;
    ReadAs as;
    Stored values;
    std::string (*file)();
    int width, height;
    // Components of the pixels top left and bottom right, layer after layer. A negative one is not compared.
    std::vector<double> first, last;
    double within = 0;
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
    return pngOf({PNG_COLOR_TYPE_RGB,
                  16,
                  2,
                  {std::vector<std::uint8_t>(12, 7), std::vector<std::uint8_t>(12, 9)},
                  true});
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

std::string exrLines() {
    return exrOf({{"", {{"R", Imf::HALF}, {"G", Imf::FLOAT}, {"B", Imf::UINT}}}});
}
std::string exrTiles() {
    MadePart a{"a", {{"R", Imf::HALF}}}, b{"b", {{"Z", Imf::FLOAT}}};
    b.tile = 4;
    return exrOf({a, b});
}
std::string deepTiff() {
    return madeTiff(3, 2, 3, 16, 1, std::string(18, 'a') + std::string(18, 'z')).bytes();
}
const std::string hdr_head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X ";
std::string plainHdr() {
    return hdr_head + "2\n\x80\x40\x20\x81\x09\x09\x09\x81";
}
std::string runsHdr() {
    return hdr_head +
           "8\n\x02\x02\x00\x08\x88\xc8\x08\x01\x02\x03\x04\x05\x06\x07\x08\x83\x05\x85\x06\x88\x80"s;
}
// From the bottom.
std::string plainPfm() {
    return "PF\n1 2\n-1.0\n" + std::string(12, '\x3f') + std::string(12, '\x40');
}

// IEND, and the checksum before it.
constexpr std::size_t png_end = 12 + 4;

std::vector<double> codes(std::vector<double> values) {
    for (double& value : values) value /= 255;
    return values;
}
const std::vector<double> nines = codes({9, 9, 9, 9}), five_to_eight = codes({5, 6, 7, 8}),
                          palette_first = codes({255, 0, 51, 51}), palette_last = codes({102, 204, 0, 255}),
                          orange = codes({200, 100, 50}), opaque_orange = codes({200, 100, 50, 255}),
                          ink = codes({7, 4, 2}), opaque_ink = codes({7, 4, 2, 255});
constexpr double jpeg_step = 1.5 / 255;
const WebpPixels opaque_webp = colourfulWebp(37, 21, true), glassy_webp = colourfulWebp(37, 21, false),
                 small_webp = colourfulWebp(9, 7, false);
std::vector<double> firstOf(const WebpPixels& of, bool colour) {
    std::vector<double> pixel = codes({of.rgba.begin(), of.rgba.begin() + 4});
    if (!colour) std::fill_n(pixel.begin(), 3, -1);
    return pixel;
}
std::vector<double> lastOf(const WebpPixels& of, bool colour) {
    return firstOf({1, 1, {of.rgba.end() - 4, of.rgba.end()}}, colour);
}

const ReaderRow readerRows[] = {
    {"exr_lines", ReadAs::image, Stored::linear, exrLines, 9, 6, {0, 40, 80}, {25, 65, 105}},
    {"exr_tiles_of_two_parts", ReadAs::image, Stored::linear, exrTiles, 9, 6, {0, 100}, {25, 125}},
    {"png", ReadAs::image, Stored::coded, plainPng, 2, 2, nines, five_to_eight, 0, png_end},
    {"png_interlaced", ReadAs::image, Stored::coded, deepPng, 2, 2, codes({7, 7, 7}), codes({9, 9, 9}), 0,
     png_end},
    {"png_palette", ReadAs::image, Stored::coded, palettePng, 3, 2, palette_first, palette_last, 0, png_end},
    {"jpeg", ReadAs::image, Stored::coded, colorJpeg, 16, 16, orange, orange, jpeg_step},
    {"jpeg_progressive", ReadAs::image, Stored::coded, progressiveJpeg, 16, 16, orange, orange, jpeg_step},
    {"jpeg_inks", ReadAs::image, Stored::coded, inkJpeg, 16, 16, ink, ink, jpeg_step},
    {"tiff", ReadAs::image, Stored::coded, deepTiff, 3, 2, codes({'a', 'a', 'a'}), codes({'z', 'z', 'z'})},
    {"hdr",
     ReadAs::image,
     Stored::linear,
     plainHdr,
     2,
     1,
     {128.5 / 128, 64.5 / 128, 32.5 / 128},
     {9.5 / 128, 9.5 / 128, 9.5 / 128}},
    {"hdr_runs",
     ReadAs::image,
     Stored::linear,
     runsHdr,
     8,
     1,
     {200.5 / 256, 1.5 / 256, 5.5 / 256},
     {200.5 / 256, 8.5 / 256, 6.5 / 256}},
    {"pfm", ReadAs::image, Stored::linear, plainPfm, 1, 2, std::vector(3, 0x1.80808p1),
     std::vector(3, 0x1.7e7e7ep-1)},
    {"png_texture", ReadAs::texture, Stored::coded, plainPng, 2, 2, nines, five_to_eight, 0, png_end},
    {"png_interlaced_texture", ReadAs::texture, Stored::coded, deepPng, 2, 2, codes({7, 7, 7, 255}),
     codes({9, 9, 9, 255}), 0, png_end},
    {"png_palette_texture", ReadAs::texture, Stored::coded, palettePng, 3, 2, palette_first, palette_last, 0,
     png_end},
    {"jpeg_texture", ReadAs::texture, Stored::coded, colorJpeg, 16, 16, opaque_orange, opaque_orange,
     jpeg_step},
    {"jpeg_progressive_texture", ReadAs::texture, Stored::coded, progressiveJpeg, 16, 16, opaque_orange,
     opaque_orange, jpeg_step},
    {"jpeg_inks_texture", ReadAs::texture, Stored::coded, inkJpeg, 16, 16, opaque_ink, opaque_ink, jpeg_step},
    {"webp_lossless", ReadAs::texture, Stored::coded, [] { return losslessWebp(small_webp); }, 9, 7,
     firstOf(small_webp, true), lastOf(small_webp, true)},
    {"webp_one_colour", ReadAs::texture, Stored::coded,
     [] {
         return losslessWebp(plainWebp(9, 7, {1, 2, 3, 255}));
     },
     9, 7, codes({1, 2, 3, 255}), codes({1, 2, 3, 255})},
    {"webp_lossy", ReadAs::texture, Stored::coded, [] { return lossyWebp(opaque_webp); }, 37, 21,
     firstOf(opaque_webp, false), lastOf(opaque_webp, false)},
    {"webp_alpha", ReadAs::texture, Stored::coded, [] { return lossyWebp(glassy_webp); }, 37, 21,
     firstOf(glassy_webp, false), lastOf(glassy_webp, false)},
};

struct WasRead {
    int width, height;
    Stored values = Stored::coded;
    bool straight = true;  // colours are not premultiplied
    std::vector<double> first{}, last{};
};

class EveryReader : public testing::TestWithParam<ReaderRow> {
protected:
    // Reads the bytes and checks that the pixels are as many as the size says.
    WasRead read(std::string_view bytes) const {
        if (row_.as == ReadAs::texture) {
            const TextureImage image =
                decodeImage({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
            EXPECT_EQ(image.rgba.size() + image.rgba16.size(), std::size_t{4} *
                                                                   static_cast<std::size_t>(image.width) *
                                                                   static_cast<std::size_t>(image.height));
            WasRead found{image.width, image.height};
            const auto append = [&](std::size_t location, std::vector<double>& to) {
                for (std::size_t c = location; c < location + 4; ++c)
                    to.push_back(image.rgba.empty() ? image.rgba16[c] / 65535.0 : image.rgba[c] / 255.0);
            };
            append(0, found.first);
            append(image.components() - 4, found.last);
            return found;
        }
        const std::span raw = std::as_bytes(std::span(bytes));
        const ImageFile file = readImage(raw, "a", {}, 1 << 20);
        const ImageSize size = imageSize(raw, "a");
        EXPECT_EQ(size.width, file.width) << "as the header says";
        EXPECT_EQ(size.height, file.height);
        WasRead found{file.width, file.height, file.display_referred ? Stored::coded : Stored::linear,
                      file.straight_alpha};
        for (const ImageLayer& layer : file.layers) {
            EXPECT_EQ(layer.image.width, file.width);
            EXPECT_EQ(layer.image.height, file.height);
            EXPECT_EQ(layer.image.data.size(), layer.image.pixels() * layer.channels.size());
            const auto components = static_cast<std::ptrdiff_t>(layer.channels.size());
            found.first.insert(found.first.end(), layer.image.data.begin(),
                               layer.image.data.begin() + components);
            found.last.insert(found.last.end(), layer.image.data.end() - components, layer.image.data.end());
        }
        return found;
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

void expectPixel(const std::vector<double>& read, const std::vector<double>& expected, double within) {
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t c = 0; c < read.size(); ++c)
        if (expected[c] >= 0) {
            EXPECT_NEAR(read[c], expected[c], within + 1e-7) << c;
        }
}

TEST_P(EveryReader, ReadsSizeOrientationColourSpaceAndAlpha) {
    const WasRead found = read(whole_);
    EXPECT_EQ(found.width, row_.width);
    EXPECT_EQ(found.height, row_.height);
    EXPECT_EQ(found.values, row_.values);
    const bool has_alpha = !std::string_view(row_.name).starts_with("jpeg") || row_.as == ReadAs::texture;
    EXPECT_EQ(found.straight, row_.values == Stored::coded && has_alpha);
    expectPixel(found.first, row_.first, row_.within);
    expectPixel(found.last, row_.last, row_.within);
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
