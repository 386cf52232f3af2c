// SPDX-License-Identifier: MIT
// One reader for all images: format detection by the first bytes, and the values of PNGs.
#include "shared/image/image_file.h"
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"
#include "shared/image/image_rows.h"
#include "shared/image/pfm.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/png_builder.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using Values = PixelData;

ImageFile imageOf(const std::string& file, std::string_view part = {}) {
    return readImage(std::as_bytes(std::span(file)), "a", part);
}
std::string imageFault(const std::string& file, std::string_view part = {}) {
    return faultOf([&] { imageOf(file, part); });
}

TEST(ImageFile, TheFirstBytesSayWhatItIsNotTheEnding) {
    const fs::path here = folder();
    Image image(2, 1, 3);
    image.data = {0.5f, 1, 2, 4, 8, 0.25f};
    writeExr(here / "exr.png", {{{"R", "G", "B"}, &image}}, {{"scene", "box.glb"}});
    writePfm(here / "pfm.exr", image);
    writeHdr(here / "hdr.pfm", image);
    writePng(here / "png.hdr", {2, 1, 3, {0, 51, 255, 102, 204, 255}});

    const ImageFile exr = readImage(here / "exr.png"), pfm = readImage(here / "pfm.exr"),
                    hdr = readImage(here / "hdr.pfm"), png = readImage(here / "png.hdr");
    EXPECT_EQ(exr.format, "OpenEXR");
    EXPECT_EQ(pfm.format, "PFM");
    EXPECT_EQ(hdr.format, "Radiance HDR");
    EXPECT_EQ(png.format, "PNG");
    for (const ImageFile* file : {&exr, &pfm, &hdr, &png}) {
        EXPECT_EQ(file->width, 2);
        EXPECT_EQ(file->height, 1);
        ASSERT_EQ(file->layers.size(), 1u);
        EXPECT_EQ(file->layers[0].name, "");
        EXPECT_EQ(file->layers[0].channels, (Names{"R", "G", "B"}));
        EXPECT_EQ(file->display_referred, file == &png);
        EXPECT_TRUE(file->notes.lines.empty() && file->notes.not_applied.empty());
        EXPECT_TRUE(file->layers[0].exact.empty());
    }
    EXPECT_EQ(exr.layers[0].sample, "float");
    EXPECT_EQ(pfm.layers[0].sample, "float");
    EXPECT_EQ(hdr.layers[0].sample, "RGBE");
    EXPECT_EQ(png.layers[0].sample, "8 bit");
    EXPECT_EQ(exr.layers[0].image.data, image.data);
    EXPECT_EQ(pfm.layers[0].image.data, image.data);
    EXPECT_NEAR(hdr.layers[0].image.data[2], 2, 2 * 0.004) << "RGBE's step";
    EXPECT_EQ(png.layers[0].image.data, (Values{0, 0.2f, 1, 0.4f, 0.8f, 1}));
    EXPECT_EQ(png.layers[0].value(0, 2), 1.0);
    EXPECT_EQ(exr.attributes, (std::map<std::string, std::string>{{"scene", "box.glb"}}));
    EXPECT_TRUE(png.attributes.empty());
}

TEST(ImageFile, WhatIsNotReadIsToldInOneLine) {
    const std::string none =
        "a: is not a supported image; supported formats: OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PFM";
    EXPECT_EQ(imageFault(""), none);
    EXPECT_EQ(imageFault("GIF89a"), none);
    EXPECT_EQ(imageFault("\xff\xd8\xff\xe0 a JPEG"), "a: does not decode: Premature end of JPEG file");
    EXPECT_EQ(imageFault("P6\n1 1\n255\nabc"), none);
    EXPECT_EQ(imageFault("\x89PNG\n"), none) << "its line ends were changed on the way";
    EXPECT_EQ(imageFault("\x76\x2f\x31\x01"), "a: is not an EXR file");
    EXPECT_EQ(imageFault("\x89PNG\r\n\x1a\n"), "a: is cut short");
    EXPECT_EQ(imageFault("#?RADIANCE\n"), "a: its header has no end");
    EXPECT_EQ(imageFault("PF4\n1 1\n1\n"), "a: is not a PFM: it begins with \"PF4\", not PF or Pf");
    EXPECT_EQ(imageFault("PF\n1 1\n1\n", "beauty"), "a: has no parts; only OpenEXR files have them");
    EXPECT_THROW(readImage(folder() / "none.exr"), std::runtime_error);
}

struct Expected {
    Names channels;
    std::string sample;
    Values values;
};

void expectPng(const MadePng& made, const Expected& expected) {
    for (const bool interlaced : {false, true}) {
        MadePng png = made;
        png.interlaced = interlaced;
        const ImageFile file = imageOf(pngOf(png));
        SCOPED_TRACE(testing::Message()
                     << "colour " << made.color << ", " << made.bits << " bits, interlaced " << interlaced);
        EXPECT_EQ(file.layers[0].channels, expected.channels);
        EXPECT_EQ(file.layers[0].sample, expected.sample);
        EXPECT_EQ(file.layers[0].image.data, expected.values);
        EXPECT_TRUE(file.display_referred);
    }
}

TEST(ImagePng, EveryColourAndDepth) {
    const float third = 1.0f / 3, mid = 32768.0f / 65535;
    expectPng({PNG_COLOR_TYPE_GRAY, 1, 3, {{0xa0}, {0x40}}}, {{"Y"}, "8 bit", {1, 0, 1, 0, 1, 0}});
    expectPng({PNG_COLOR_TYPE_GRAY, 2, 4, {{0x1b}}}, {{"Y"}, "8 bit", {0, third, 2 * third, 1}});
    expectPng({PNG_COLOR_TYPE_GRAY, 4, 2, {{0x3f}}}, {{"Y"}, "8 bit", {0.2f, 1}});
    expectPng({PNG_COLOR_TYPE_GRAY, 8, 2, {{51, 255}}}, {{"Y"}, "8 bit", {0.2f, 1}});
    expectPng({PNG_COLOR_TYPE_GRAY, 16, 2, {{0x80, 0, 0xff, 0xff}}}, {{"Y"}, "16 bit", {mid, 1}});
    expectPng({PNG_COLOR_TYPE_GRAY_ALPHA, 8, 1, {{51, 102}}}, {{"Y", "A"}, "8 bit", {0.2f, 0.4f}});
    expectPng({PNG_COLOR_TYPE_RGB, 16, 1, {{0, 0, 0x80, 0, 0xff, 0xff}}},
              {{"R", "G", "B"}, "16 bit", {0, mid, 1}});
    expectPng({PNG_COLOR_TYPE_RGB_ALPHA, 8, 1, {{51, 102, 153, 204}}},
              {{"R", "G", "B", "A"}, "8 bit", {0.2f, 0.4f, 0.6f, 0.8f}});
    expectPng({PNG_COLOR_TYPE_RGB_ALPHA, 16, 1, {{0, 1, 0, 0, 0, 0, 0x80, 0}}},
              {{"R", "G", "B", "A"}, "16 bit", {1.0f / 65535, 0, 0, mid}});
}

TEST(ImagePng, PalettesAreLookedUpAndTransparentColoursBecomeAlpha) {
    MadePng palette{PNG_COLOR_TYPE_PALETTE, 2, 3, {{0x18}}};  // 0, 1, 2
    palette.palette = {{255, 0, 51}, {102, 204, 0}, {0, 0, 0}};
    expectPng(palette, {{"R", "G", "B"}, "8 bit", {1, 0, 0.2f, 0.4f, 0.8f, 0, 0, 0, 0}});
    palette.palette_alpha = {51};
    expectPng(palette, {{"R", "G", "B", "A"}, "8 bit", {1, 0, 0.2f, 0.2f, 0.4f, 0.8f, 0, 1, 0, 0, 0, 1}});
    MadePng gray{PNG_COLOR_TYPE_GRAY, 8, 2, {{51, 102}}};
    gray.transparent_gray = 102;
    expectPng(gray, {{"Y", "A"}, "8 bit", {0.2f, 1, 0.4f, 0}});
}

// Interlacing stores an image in seven passes; each of these sizes leaves other passes empty.
TEST(ImagePng, InterlacedRowsComeTogether) {
    for (const int side : {1, 3, 5, 8, 11}) {
        MadePng made{PNG_COLOR_TYPE_GRAY, 16, static_cast<std::uint32_t>(side), {}, true};
        Values values;
        for (int y = 0; y < side; ++y) {
            made.rows.emplace_back();
            for (int x = 0; x < side; ++x) {
                made.rows.back().push_back(static_cast<std::uint8_t>(y));
                made.rows.back().push_back(static_cast<std::uint8_t>(7 * x));
                values.push_back(static_cast<float>(256 * y + 7 * x) / 65535);
            }
        }
        EXPECT_EQ(imageOf(pngOf(made)).layers[0].image.data, values) << side;
    }
}

TEST(ImagePng, GammaOneIsLinearUnlessSrgbStandsBesideIt) {
    MadePng made{PNG_COLOR_TYPE_GRAY, 8, 1, {{51}}};
    const auto of = [&](double gamma, bool srgb, bool profile) {
        made.gamma = gamma;
        made.srgb = srgb;
        made.profile = profile;
        const ImageFile file = imageOf(pngOf(made));
        EXPECT_EQ(file.layers[0].image.data, Values{0.2f}) << "values are not converted";
        Names said{file.display_referred ? "display" : "linear"};
        said.insert(said.end(), file.notes.not_applied.begin(), file.notes.not_applied.end());
        return said;
    };
    const std::string other = "its gamma of 0.5 is not applied; its values are read as sRGB";
    EXPECT_EQ(of(0, false, false), Names{"display"});
    EXPECT_EQ(of(1, false, false), Names{"linear"});
    EXPECT_EQ(of(1, true, false), Names{"display"});
    EXPECT_EQ(of(0.45455, false, false), Names{"display"});
    EXPECT_EQ(of(0.5, false, false), (Names{"display", other}));
    for (const auto& [gamma, taken_as] : {std::pair{0, "sRGB"}, {1, "linear"}}) {
        const std::string note = of(gamma, false, true).at(1);
        EXPECT_TRUE(note.starts_with("its colour profile (3 bytes, ")) << note;
        EXPECT_TRUE(note.ends_with(std::string(") is not applied; its values are read as ") + taken_as))
            << note;
    }
}

TEST(ImagePng, BrokenFilesSayWhy) {
    const std::string whole =
        pngOf({PNG_COLOR_TYPE_RGB, 8, 4,
               std::vector<std::vector<std::uint8_t>>(4, std::vector<std::uint8_t>(12, 7))});
    EXPECT_EQ(imageFault(whole), "");
    EXPECT_EQ(imageFault(whole.substr(0, 40)), "a: is cut short");
    std::string sum = whole;
    sum[17] ^= 1;  // a wrong checksum of IHDR
    EXPECT_EQ(imageFault(sum), "a: IHDR: CRC error");
    std::string data = whole;
    data[data.find("IDAT") + 5] ^= 0x55;
    EXPECT_TRUE(imageFault(data).starts_with("a: IDAT: ")) << imageFault(data);
}

// Undecoded 8-bit values give the same floats. The header alone tells whether they stay 8-bit, and their
// size.
TEST(ImageFile, EightBitsCanBeKept) {
    const std::vector<std::vector<std::uint8_t>> rows{{0, 1, 2, 3, 4, 5, 6, 255, 128, 9, 10, 11},
                                                      {12, 13, 254, 15, 16, 17, 18, 19, 20, 21, 22, 23}};
    const auto made = [&](int color, std::uint32_t width, bool interlaced) {
        return pngOf({.color = color, .width = width, .rows = rows, .interlaced = interlaced});
    };
    for (const bool interlaced : {false, true})
        for (const auto& [color, components] : {std::pair{PNG_COLOR_TYPE_GRAY, 1},
                                                {PNG_COLOR_TYPE_GRAY_ALPHA, 2},
                                                {PNG_COLOR_TYPE_RGB, 3},
                                                {PNG_COLOR_TYPE_RGB_ALPHA, 4}}) {
            const std::string file = made(color, static_cast<std::uint32_t>(12 / components), interlaced);
            const auto bytes = std::as_bytes(std::span(file));
            const ImageFile floats = readImage(bytes, "a"),
                            kept = readImage(bytes, "a", {}, limits::imageBytes(), EightBits::kept);
            const Image& image = floats.layers[0].image;
            const Image8& coded = kept.layers[0].coded;
            EXPECT_TRUE(kept.layers[0].image.empty());
            EXPECT_TRUE(floats.layers[0].coded.data.empty());
            EXPECT_EQ(kept.layers[0].channels, floats.layers[0].channels);
            EXPECT_EQ(kept.width, floats.width);
            ASSERT_EQ(coded.data.size(), image.data.size());
            EXPECT_EQ((StoredImage{{}, coded, components}.takeImage().data), image.data);
            const ImageSize size = imageSize(bytes, "a", {}, EightBits::kept);
            EXPECT_EQ(size.width, kept.width);
            EXPECT_EQ(size.height, 2);
            EXPECT_EQ(size.bytes_per_pixel, components);
            EXPECT_EQ(imageSize(bytes, "a").bytes_per_pixel, (interlaced ? 5 : 4) * components);
        }
    const std::string deep = pngOf({.color = PNG_COLOR_TYPE_GRAY, .bits = 16, .width = 6, .rows = rows});
    const auto bytes = std::as_bytes(std::span(deep));
    EXPECT_EQ(readImage(bytes, "a", {}, limits::imageBytes(), EightBits::kept).layers[0].image.data,
              readImage(bytes, "a").layers[0].image.data);
    EXPECT_EQ(imageSize(bytes, "a", {}, EightBits::kept).bytes_per_pixel, 4);
}

TEST(ImageFile, SizesAreKnownFromHeaders) {
    const fs::path here = folder();
    const Image image(5, 3, 3, 0.5f), one(5, 3, 1, 2);
    writeExr(here / "a.exr", {{{"R", "G", "B"}, &image}, {{"Z"}, &one}});
    writePfm(here / "a.pfm", image);
    writePfm(here / "b.pfm", one);
    writeHdr(here / "a.hdr", image);
    for (const auto& [name, bytes] : {std::pair{"a.exr", 16}, {"a.pfm", 12}, {"b.pfm", 4}, {"a.hdr", 12}}) {
        const std::string file = contentsOf(here / name);
        const ImageSize size = imageSize(std::as_bytes(std::span(file)), name);
        EXPECT_EQ(size.width, 5) << name;
        EXPECT_EQ(size.height, 3) << name;
        EXPECT_EQ(size.bytes_per_pixel, bytes) << name;
    }
    const std::string nothing = "nothing";
    EXPECT_THROW(imageSize(std::as_bytes(std::span(nothing)), "a"), std::runtime_error);
}

}  // namespace
}  // namespace diptych
