// SPDX-License-Identifier: MIT
// Colour and pixel metadata of files: converted if a matrix suffices, otherwise reported, in every format.
#include "shared/image/primaries.h"
#include "compare/files/layers.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/exr_builder.h"
#include "tests/support/files.h"
#include "tests/support/png_builder.h"
#include "tests/support/srgb.h"

#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>

namespace diptych {
namespace {

using namespace std::string_literals;
using Names = std::vector<std::string>;

constexpr Primaries rec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290},
    aces{0.7347, 0.2653, 0, 1, 0.0001, -0.0770, 0.32168, 0.33767},
    display_p3{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
const std::string converted = "its colours were converted from the primaries x, y ";

ImageFile decodedFrom(const std::string& file) {
    return readImage(std::as_bytes(std::span(file)), "a");
}

std::string bigEndianOf(std::initializer_list<std::uint32_t> numbers) {
    std::string text;
    for (const std::uint32_t number : numbers)
        for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(number >> shift);
    return text;
}

// ACES: AP0 to Rec. 709 of Academy TB-2018-001, with Bradford adaptation of D60. Display P3: CSS Color 4,
// 10.8, same white. Rows as printed there.
TEST(Primaries, MatricesAreThePublishedOnes) {
    const double from_aces[9] = {2.521686,  -1.134131, -0.387555, -0.276480, 1.372719,
                                 -0.096239, -0.015378, -0.152975, 1.168353},
                 from_p3[9] = {1.224940, -0.224940, 0,         -0.042057, 1.042057,
                               0,        -0.019638, -0.078636, 1.098274};
    for (const auto& [primaries, expected] : {std::pair{aces, from_aces}, {display_p3, from_p3}}) {
        FileNotes notes;
        const auto matrix = matrixToRec709(primaries, notes);
        ASSERT_TRUE(matrix);
        for (int i = 0; i < 9; ++i) EXPECT_NEAR((*matrix)[i % 3][i / 3], expected[i], 2e-4) << i;
        ASSERT_EQ(notes.lines.size(), 1u);
        EXPECT_TRUE(notes.lines[0].starts_with(converted)) << notes.lines[0];
        EXPECT_TRUE(notes.not_applied.empty());
    }
}

TEST(Primaries, Rec709ToFourDigitsIsNothingAndALineIsNoColours) {
    FileNotes notes;
    Primaries rounded = rec709;
    rounded[6] = 0.31271;
    EXPECT_FALSE(matrixToRec709(rounded, notes));
    EXPECT_TRUE(notes.lines.empty() && notes.not_applied.empty());
    for (const Primaries& none : {Primaries{}, Primaries{0.3, 0.3, 0.4, 0.4, 0.5, 0.5, 0.3127, 0.3290},
                                  Primaries{std::nan(""), 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290}}) {
        FileNotes said;
        EXPECT_FALSE(matrixToRec709(none, said));
        ASSERT_EQ(said.not_applied.size(), 1u);
        EXPECT_TRUE(said.not_applied[0].ends_with("do not span a colour space; Rec. 709 is assumed"));
    }
}

// Only colours are converted: R, G, B of normals stay unchanged.
TEST(Primaries, OfAnExr) {
    const MadePart part{"",
                        {{"R", Imf::FLOAT},
                         {"G", Imf::FLOAT},
                         {"B", Imf::FLOAT},
                         {"normals.R", Imf::FLOAT},
                         {"normals.G", Imf::FLOAT},
                         {"normals.B", Imf::FLOAT}}};
    const auto with = [&](const Primaries& p, float aspect, float white) {
        const auto xy = [&](std::size_t i) {
            return Imath::V2f(static_cast<float>(p[2 * i]), static_cast<float>(p[2 * i + 1]));
        };
        return decodedFrom(exrOf({part}, [&](std::vector<Imf::Header>& heads) {
            Imf::addChromaticities(heads[0], {xy(0), xy(1), xy(2), xy(3)});
            if (white > 0) Imf::addWhiteLuminance(heads[0], white);
            heads[0].pixelAspectRatio() = aspect;
        }));
    };
    const auto channel = [](const ImageFile& file, const char* name) {
        for (ImageChannel& found : channelsOf(file, {}))
            if (found.name == name) return std::move(found.image);
        return Image();
    };
    const ImageFile plain = with(rec709, 1, 0), other = with(aces, 2, 100);
    EXPECT_TRUE(plain.notes.lines.empty() && plain.notes.not_applied.empty());
    ASSERT_EQ(other.notes.lines.size(), 1u);
    EXPECT_EQ(other.notes.not_applied, (Names{"its pixels are not square (aspect 2) but are shown square",
                                              "its white luminance of 100 cd/m2 is not applied"}));
    EXPECT_EQ(channel(plain, "normals").data, channel(other, "normals").data);
    const Image stored = channel(plain, "lit"), shown = channel(other, "lit");
    FileNotes notes;
    const glm::dmat3 matrix = *matrixToRec709(aces, notes);
    for (std::size_t i = 0; i < stored.pixels(); ++i) {
        const glm::dvec3 expected =
            matrix * glm::dvec3(stored.pixel(i)[0], stored.pixel(i)[1], stored.pixel(i)[2]);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.pixel(i)[c], expected[c], 1e-3) << i;
    }
}

TEST(Primaries, OfARadianceImage) {
    const auto with = [](const std::string& variables) {
        return decodedFrom("#?RADIANCE\n" + variables +
                           "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81"s);
    };
    // Grey stays grey with any white point.
    const ImageFile grey =
        with("PRIMARIES= .64 .33 .29 .60 .15 .06 .3333 .3333\nPIXASPECT=0.5\nEXPOSURE=2\n");
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(grey.layers[0].image.data[static_cast<std::size_t>(c)], 1.00390625f / 2, 1e-6);
    ASSERT_EQ(grey.notes.lines.size(), 2u);
    EXPECT_EQ(grey.notes.lines[0], "its values were multiplied by 0.5 0.5 0.5 (its EXPOSURE and COLORCORR)");
    EXPECT_TRUE(grey.notes.lines[1].starts_with(converted));
    EXPECT_EQ(grey.notes.not_applied, Names{"its pixels are not square (aspect 0.5) but are shown square"});
    EXPECT_EQ(faultOf([&] { with("PRIMARIES=1 2 3\n"); }), "a: PRIMARIES=1 2 3 is not eight numbers");
}

// Display P3's full green is outside sRGB: its red is negative, also when encoded.
TEST(Primaries, OfAPng) {
    MadePng made{PNG_COLOR_TYPE_RGB, 8, 1, {{0, 255, 0}}};
    made.chunks = {{"cHRM", bigEndianOf({31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000})}};
    const auto encoded = [](double l) { return std::copysign(encodedSrgb(std::abs(l)), l); };
    for (const EightBits eight : {EightBits::decoded, EightBits::kept}) {
        const std::string bytes = pngOf(made);
        const ImageFile file =
            readImage(std::as_bytes(std::span(bytes)), "a", {}, limits::imageBytes(), eight);
        ASSERT_EQ(file.layers[0].image.data.size(), 3u) << "converted, so kept as floats";
        EXPECT_EQ(imageSize(std::as_bytes(std::span(bytes)), "a", {}, eight).bytes_per_pixel, 12);
        const double expected[3] = {encoded(-0.224940), encoded(1.042057), encoded(-0.078636)};
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(file.layers[0].image.data[c], expected[c], 2e-4) << c;
        EXPECT_TRUE(file.notes.lines.at(0).starts_with(converted));
    }
    made.gamma = 1;
    EXPECT_NEAR(decodedFrom(pngOf(made)).layers[0].image.data[0], -0.224940, 2e-4) << "linear values";
    made.srgb = true;
    EXPECT_TRUE(decodedFrom(pngOf(made)).notes.lines.empty()) << "sRGB has precedence";
    made = {PNG_COLOR_TYPE_GRAY, 8, 1, {{51}}, false, {}, {}, -1, 0, false, false, made.chunks};
    EXPECT_EQ(decodedFrom(pngOf(made)).layers[0].image.data, PixelData{0.2f}) << "grey has no primaries";
}

TEST(Primaries, WhatAPngSaysBesideThem) {
    MadePng made{PNG_COLOR_TYPE_RGB, 8, 1, {{0, 255, 0}}};
    made.chunks = {{"cICP", "\x0c\x10\x00\x01"s},
                   {"acTL", bigEndianOf({3, 0})},
                   {"pHYs", bigEndianOf({2000, 1000}) + "\0"s}};
    EXPECT_EQ(
        decodedFrom(pngOf(made)).notes.not_applied,
        (Names{
            "its pixels are not square (aspect 0.5) but are shown square",
            "its colour code points 12 16 0 1 (ITU-T H.273) are not applied; its values are read as sRGB"}));
    EXPECT_EQ(decodedFrom(pngOf(made)).notes.in_part, Names{"only the first of its 3 frames is read"});
    made.chunks = {{"cICP", "\x01\x0d\x00\x01"s},
                   {"acTL", bigEndianOf({1, 0})},
                   {"pHYs", bigEndianOf({2835, 2835}) + "\1"s}};
    EXPECT_TRUE(decodedFrom(pngOf(made)).notes.not_applied.empty()) << "sRGB, square";
    EXPECT_TRUE(decodedFrom(pngOf(made)).notes.in_part.empty()) << "one frame";
}

}  // namespace
}  // namespace diptych
