// SPDX-License-Identifier: MIT
// Images of every type that glTF may use, written by libpng and libjpeg, decode to the stored numbers.
#include "shared/scene/image/decode.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/jpeg_builder.h"
#include "tests/support/png_builder.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

using Bytes = std::vector<unsigned char>;

Bytes pngFile(const MadePng& made) {
    const std::string file = pngOf(made);
    return {file.begin(), file.end()};
}

std::string failure(const Bytes& file) {
    return faultOf([&] { decodeImage(file); });
}

void expectRgba(const Bytes& file, const Bytes& rgba) {
    const TextureImage image = decodeImage(file);
    EXPECT_EQ(image.rgba, rgba);
    EXPECT_TRUE(image.rgba16.empty());
}

void expectColor(const Bytes& file, int r, int g, int b, int tolerance = 1) {
    const TextureImage image = decodeImage(file);
    ASSERT_EQ(image.width, 16);
    ASSERT_EQ(image.height, 16);
    ASSERT_EQ(image.rgba.size(), 4u * 256);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        EXPECT_NEAR(image.rgba[i], r, tolerance);
        EXPECT_NEAR(image.rgba[i + 1], g, tolerance);
        EXPECT_NEAR(image.rgba[i + 2], b, tolerance);
        EXPECT_EQ(image.rgba[i + 3], 255);
    }
}

}  // namespace

// ---- PNG ---------------------------------------------------------------------------------------------

TEST(ImageDecode, EightBitsOfEveryColourType) {
    expectRgba(
        pngFile({PNG_COLOR_TYPE_RGBA, 8, 2, {{1, 2, 3, 4, 5, 6, 7, 8}, {9, 10, 11, 12, 13, 14, 15, 0}}}),
        {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0});
    expectRgba(pngFile({PNG_COLOR_TYPE_RGB, 8, 2, {{1, 2, 3, 5, 6, 7}, {9, 10, 11, 13, 14, 15}}}),
               {1, 2, 3, 255, 5, 6, 7, 255, 9, 10, 11, 255, 13, 14, 15, 255});
    expectRgba(pngFile({PNG_COLOR_TYPE_GRAY, 8, 2, {{1, 2}, {3, 255}}}),
               {1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255, 255, 255, 255, 255});
    expectRgba(pngFile({PNG_COLOR_TYPE_GRAY_ALPHA, 8, 2, {{1, 20, 2, 30}, {3, 40, 4, 0}}}),
               {1, 1, 1, 20, 2, 2, 2, 30, 3, 3, 3, 40, 4, 4, 4, 0});
}

// Grey of few bits is expanded to 0 to 255: steps of 255 for 1 bit, 85 for 2 bits, 17 for 4 bits.
TEST(ImageDecode, FewBits) {
    const auto grey = [](int a, int b) {
        Bytes out;
        for (const int v : {a, b, b, a})
            for (const int c : {v, v, v, 255}) out.push_back(static_cast<unsigned char>(c));
        return out;
    };
    expectRgba(pngFile({PNG_COLOR_TYPE_GRAY, 1, 2, {{0x40}, {0x80}}}), grey(0, 255));
    expectRgba(pngFile({PNG_COLOR_TYPE_GRAY, 2, 2, {{0x60}, {0x90}}}), grey(85, 170));
    expectRgba(pngFile({PNG_COLOR_TYPE_GRAY, 4, 2, {{0x3f}, {0xf3}}}), grey(51, 255));
}

TEST(ImageDecode, PalettesWithAndWithoutAlpha) {
    const auto build = [](int depth, const std::vector<Bytes>& rows, bool alpha) {
        MadePng made{PNG_COLOR_TYPE_PALETTE, depth, 2, rows};
        made.palette = {{1, 2, 3}, {40, 50, 60}, {255, 0, 128}};
        if (depth == 1) made.palette.pop_back();
        if (alpha) made.palette_alpha = {7, 8};
        return pngFile(made);
    };
    const auto expected = [](bool alpha) {
        const auto a = [&](int v) { return static_cast<unsigned char>(alpha ? v : 255); };
        return Bytes{1, 2, 3, a(7), 40, 50, 60, a(8), 255, 0, 128, 255, 1, 2, 3, a(7)};
    };
    for (const bool alpha : {false, true}) {
        expectRgba(build(8, {{0, 1}, {2, 0}}, alpha), expected(alpha));
        expectRgba(build(4, {{0x01}, {0x20}}, alpha), expected(alpha));
        expectRgba(build(2, {{0x10}, {0x80}}, alpha), expected(alpha));
    }
    expectRgba(build(1, {{0x40}, {0x80}}, true), {1, 2, 3, 7, 40, 50, 60, 8, 40, 50, 60, 8, 1, 2, 3, 7});
}

// tRNS of grey and colour images makes one value transparent; 16-bit values must match in all bits.
TEST(ImageDecode, OneTransparentColour) {
    MadePng grey{PNG_COLOR_TYPE_GRAY, 8, 2, {{1, 2}, {3, 2}}},
        deep{PNG_COLOR_TYPE_GRAY, 16, 2, {{0, 1, 0, 2}}};
    grey.transparent_gray = deep.transparent_gray = 2;
    expectRgba(pngFile(grey), {1, 1, 1, 255, 2, 2, 2, 0, 3, 3, 3, 255, 2, 2, 2, 0});
    EXPECT_EQ(decodeImage(pngFile(deep)).rgba16, (std::vector<std::uint16_t>{1, 1, 1, 65535, 2, 2, 2, 0}));
    MadePng color{PNG_COLOR_TYPE_RGB, 8, 2, {{1, 2, 3, 1, 2, 4}, {5, 2, 3, 1, 2, 3}}};
    color.transparent_color = {1, 2, 3};
    expectRgba(pngFile(color), {1, 2, 3, 0, 1, 2, 4, 255, 5, 2, 3, 255, 1, 2, 3, 0});
}

TEST(ImageDecode, SixteenBitsStaySixteen) {
    const TextureImage color =
        decodeImage(pngFile({PNG_COLOR_TYPE_RGBA, 16, 1, {{0x12, 0x34, 0, 1, 0xff, 0xfe, 0x80, 0}}}));
    EXPECT_EQ(color.rgba16, (std::vector<std::uint16_t>{0x1234, 1, 0xfffe, 0x8000}));
    EXPECT_TRUE(color.rgba.empty());
    EXPECT_EQ(decodeImage(pngFile({PNG_COLOR_TYPE_RGB, 16, 1, {{0, 1, 0, 2, 0, 3}}})).rgba16,
              (std::vector<std::uint16_t>{1, 2, 3, 65535}));
    EXPECT_EQ(decodeImage(pngFile({PNG_COLOR_TYPE_GRAY, 16, 1, {{0xab, 0xcd}}})).rgba16,
              (std::vector<std::uint16_t>{0xabcd, 0xabcd, 0xabcd, 65535}));
    EXPECT_EQ(decodeImage(pngFile({PNG_COLOR_TYPE_GRAY_ALPHA, 16, 1, {{0xab, 0xcd, 0, 9}}})).rgba16,
              (std::vector<std::uint16_t>{0xabcd, 0xabcd, 0xabcd, 9}));
}

TEST(ImageDecode, InterlacedImagesAreWhole) {
    MadePng made{PNG_COLOR_TYPE_RGBA, 8, 13, {}};
    for (int y = 0; y < 11; ++y) {
        Bytes row;
        for (int x = 0; x < 13; ++x)
            for (const int c : {x, y, x * y, 255 - x}) row.push_back(static_cast<unsigned char>(c));
        made.rows.push_back(row);
    }
    const TextureImage straight = decodeImage(pngFile(made));
    made.interlaced = true;
    EXPECT_EQ(decodeImage(pngFile(made)).rgba, straight.rgba);
    EXPECT_EQ(straight.rgba[4 * (13 * 10 + 12)], 12);
    EXPECT_EQ(straight.rgba[4 * (13 * 10 + 12) + 1], 10);
}

// glTF 2.0, 3.8.3: gamma, chromaticities and profiles have no effect; texts and broken profiles are
// skipped.
TEST(ImageDecode, AncillaryChunksChangeNothing) {
    MadePng made{PNG_COLOR_TYPE_RGB, 8, 2, {{10, 20, 30, 40, 50, 60}}};
    const Bytes expected = decodeImage(pngFile(made)).rgba;
    const Bytes long_text(1 << 20, 'x');
    uLongf size = compressBound(long_text.size());
    std::string packed(size, ' ');
    ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size, long_text.data(), long_text.size()),
              Z_OK);
    made.gamma = 1;
    made.chunks = {{"sBIT", "\4\4\4"}, {"zTXt", std::string("Comment\0\0", 9) + packed.substr(0, size)}};
    EXPECT_EQ(decodeImage(pngFile(made)).rgba, expected);
}

// ---- JPEG --------------------------------------------------------------------------------------------

// Images of a single colour, so that only the colour transform rounds.
TEST(ImageDecode, JpegsOfEveryColourSpace) {
    for (const bool progressive : {false, true}) {
        expectColor(jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77}, progressive), 77, 77, 77);
        expectColor(jpeg(JCS_RGB, JCS_YCbCr, {200, 100, 50}, progressive), 200, 100, 50, 2);
        expectColor(jpeg(JCS_RGB, JCS_RGB, {200, 100, 50}, progressive), 200, 100, 50);
        // Adobe's files store inverted inks: cyan leaves 200 of 255, black leaves 128: 200 x 128 / 255.
        expectColor(jpeg(JCS_CMYK, JCS_CMYK, {200, 255, 0, 128}, progressive), 100, 128, 0);
        expectColor(jpeg(JCS_CMYK, JCS_YCCK, {200, 255, 0, 128}, progressive), 100, 128, 0, 2);
        // Without Adobe's marker the numbers are the inks.
        expectColor(jpeg(JCS_CMYK, JCS_CMYK, {55, 0, 255, 127}, progressive, false), 100, 128, 0);
    }
}

// ---- refused files -----------------------------------------------------------------------------------

TEST(ImageDecode, OtherFilesAreRefusedByName) {
    EXPECT_EQ(failure({}), "is not PNG, JPEG or WebP");
    EXPECT_EQ(failure({'B', 'M', 'X', ' ', 'i', 's', ' ', 't', 'e', 'x', 't', '.', '.', '.'}),
              "is not PNG, JPEG or WebP");
    const auto named = [](std::string_view begin) {
        Bytes bytes(begin.begin(), begin.end());
        bytes.resize(64);
        return failure(bytes);
    };
    using namespace std::string_view_literals;
    EXPECT_EQ(named("GIF87a"), "is GIF; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("GIF89a"), "is GIF; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("\xabKTX 11\xbb\r\n\x1a\n"), "is KTX; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("\xabKTX 20\xbb\r\n\x1a\n"), "is KTX2; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("BM\x40"), "is BMP; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("II*\0"sv), "is TIFF; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("MM\0*"sv), "is TIFF; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("\0\0\0\x20"
                    "ftypavif"sv),
              "is AVIF; only PNG, JPEG and WebP are supported");
    EXPECT_EQ(named("DDS "), "is DDS; only PNG, JPEG and WebP are supported");
}

TEST(ImageDecode, WhatEndsEarlyIsSaid) {
    const Bytes png = pngFile({PNG_COLOR_TYPE_RGBA, 8, 2, {Bytes(8, 9), Bytes(8, 7)}}),
                color = jpeg(JCS_RGB, JCS_YCbCr, {200, 100, 50});
    EXPECT_EQ(failure(Bytes(png.begin(), png.begin() + 40)), "does not decode: it ends early");
    EXPECT_EQ(failure(Bytes(color.begin(), color.end() - 2)), "does not decode: Premature end of JPEG file");
}

// Sizes are checked before allocation.
TEST(ImageDecode, ClaimsThatNoFileOfItsLengthCanHold) {
    const auto sized = [](Bytes file, std::size_t at, std::vector<unsigned char> size) {
        std::copy(size.begin(), size.end(), file.begin() + static_cast<long>(at));
        return file;
    };
    const Bytes png = pngFile({PNG_COLOR_TYPE_RGBA, 8, 2, {Bytes(8, 9), Bytes(8, 7)}});
    EXPECT_EQ(failure(sized(png, 16, {0, 0, 0x40, 0, 0, 0, 0x40, 0})),
              "claims 16384 x 16384 pixels, too many for its " + std::to_string(png.size()) + " bytes");
    EXPECT_EQ(failure(sized(png, 16, {0, 0, 0x40, 1, 0, 0, 0, 1})),
              "has 16385 x 1 pixels; each side must be 1 to 16384");
    EXPECT_EQ(failure(sized(png, 16, {0, 0, 0, 0, 0, 0, 0, 1})),
              "has 0 x 1 pixels; each side must be 1 to 16384");
    EXPECT_EQ(failure(sized(png, 16, {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff})),
              "has 4294967295 x 4294967295 pixels; each side must be 1 to 16384");
    Bytes huge = jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77});
    for (std::size_t i = 0; i + 9 < huge.size(); ++i)
        if (huge[i] == 0xff && huge[i + 1] == 0xc0) huge = sized(huge, i + 5, {0x40, 0, 0x40, 0});
    EXPECT_EQ(failure(huge),
              "claims 16384 x 16384 pixels, too many for its " + std::to_string(huge.size()) + " bytes");
}

// A few bytes make a scan that visits all pixels. These scans change nothing and are valid. An image of up
// to a megapixel may have 4096 of them.
TEST(ImageDecode, EndlessScansAreRefused) {
    static const jpeg_scan_info scans[] = {{1, {0}, 0, 0, 0, 0}, {1, {0}, 1, 63, 0, 0}};
    const Bytes file = jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77}, false, true, scans);
    std::size_t second = 0;
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == 0xff && file[i + 1] == 0xda) second = i;
    const auto withScans = [&](int more) {
        Bytes many(file.begin(), file.end() - 2);
        for (int i = 0; i < more; ++i)
            many.insert(many.end(), file.begin() + static_cast<long>(second), file.end() - 2);
        many.insert(many.end(), {0xff, 0xd9});
        return many;
    };
    expectColor(withScans(100), 77, 77, 77);
    EXPECT_EQ(failure(withScans(5000)), "does not decode: it has at least 4097 scans");
}

TEST(ImageDecode, ArithmeticCodingIsNamed) {
    Bytes file = jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77});
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == 0xff && file[i + 1] == 0xc0) file[i + 1] = 0xc9;
    EXPECT_EQ(failure(file), "is a JPEG with arithmetic coding, which is not supported");
}

// ---- JPEG as an image --------------------------------------------------------------------------------

// Width / height of a pixel is Y over X density, whether these are dots per unknown unit, inch or cm.
TEST(ImageDecode, DensitiesOfAJpegAreThePixelsAspect) {
    const auto notes = [](unsigned units, unsigned x, unsigned y) {
        Bytes file = jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77});
        EXPECT_EQ(std::string(file.begin() + 6, file.begin() + 10), "JFIF");
        file.at(13) = static_cast<unsigned char>(units);
        file.at(14) = static_cast<unsigned char>(x >> 8);
        file.at(15) = static_cast<unsigned char>(x & 255);
        file.at(16) = static_cast<unsigned char>(y >> 8);
        file.at(17) = static_cast<unsigned char>(y & 255);
        return readImage(std::as_bytes(std::span(file)), "a.jpg").notes.not_applied;
    };
    using Notes = std::vector<std::string>;
    for (const unsigned units : {0u, 1u, 2u}) {
        EXPECT_EQ(notes(units, 300, 600), Notes{"its pixels are not square (aspect 2) but are shown square"});
        EXPECT_EQ(notes(units, 600, 150),
                  Notes{"its pixels are not square (aspect 0.25) but are shown square"});
        EXPECT_EQ(notes(units, 72, 72), Notes{});
        EXPECT_EQ(notes(units, 0, 72), Notes{}) << "no density";
        EXPECT_EQ(notes(units, 72, 0), Notes{}) << "no density";
    }
}

// One decoder: diff compares the same bytes that a texture has.
TEST(ImageDecode, AJpegIsAnImageOfTheSameBytes) {
    for (const bool grey : {false, true}) {
        const Bytes file =
            grey ? jpeg(JCS_GRAYSCALE, JCS_GRAYSCALE, {77}) : jpeg(JCS_RGB, JCS_YCbCr, {200, 30, 90});
        const TextureImage texture = decodeImage(file);
        const ImageFile stored = readImage(std::as_bytes(std::span(file)), "a.png");
        EXPECT_EQ(stored.format, "JPEG");
        EXPECT_TRUE(stored.display_referred);
        ASSERT_EQ(stored.layers.size(), 1u);
        const Image& image = stored.layers[0].image;
        ASSERT_EQ(image.components, grey ? 1 : 3);
        ASSERT_EQ(image.pixels(), 256u);
        for (std::size_t i = 0; i < image.pixels(); ++i)
            for (int c = 0; c < image.components; ++c)
                EXPECT_EQ(image.pixel(i)[c],
                          static_cast<float>(texture.rgba[4 * i + static_cast<std::size_t>(c)]) / 255);
    }
    const Bytes file = jpeg(JCS_RGB, JCS_YCbCr, {1, 2, 3});
    // JFIF and ICC data: a density of 2 by 1, and a profile in two parts.
    Bytes told = file;
    ASSERT_EQ(told.at(3), 0xe0);
    told.at(15) = 2;
    const std::string parts = std::string("\xff\xe2\x00\x11ICC_PROFILE\0\1\2a", 19) +
                              std::string("\xff\xe2\x00\x12ICC_PROFILE\0\2\2bc", 20);
    told.insert(told.begin() + 20, parts.begin(), parts.end());
    const std::vector<std::string> notes =
        readImage(std::as_bytes(std::span(told)), "a.jpg").notes.not_applied;
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], "its pixels are not square (aspect 0.5) but are shown square");
    EXPECT_TRUE(notes[1].starts_with("its colour profile (3 bytes, ")) << notes[1];
    const auto imageFault = [](std::span<const unsigned char> bytes, std::uint64_t max) {
        return faultOf([&] { readImage(std::as_bytes(bytes), "a.jpg", {}, max); });
    };
    EXPECT_TRUE(imageFault(file, 100).starts_with("a.jpg: ")) << "more memory than allowed";
}
