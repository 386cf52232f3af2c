// SPDX-License-Identifier: MIT
// TIFFs made byte by byte, independent of the library that reads them.
#include "shared/image/tiff.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/tiff_builder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

template <class T>
std::string stored(const std::vector<T>& values) {
    std::string out(sizeof(T) * values.size(), '\0');
    std::memcpy(out.data(), values.data(), out.size());
    return out;
}

TiffImage read(const MadeTiff& file, std::uint64_t max = 1 << 20) {
    const std::string bytes = file.bytes();
    return readTiff(std::as_bytes(std::span(bytes)), "a.tif", max);
}

std::string tiffFault(const std::string& bytes, std::uint64_t max = 1 << 20) {
    return faultOf([&] { readTiff(std::as_bytes(std::span(bytes)), "a.tif", max); });
}

TEST(Tiff, EverySampleIsReadAsItIs) {
    const TiffImage octets = read(madeTiff(2, 2, 1, 8, 1, stored<std::uint8_t>({0, 51, 102, 255})));
    EXPECT_EQ(octets.image.data, (PixelData{0, 51 / 255.0f, 102 / 255.0f, 1}));
    EXPECT_EQ(octets.sample, "8 bit");
    EXPECT_FALSE(octets.linear);
    const TiffImage words = read(madeTiff(2, 1, 1, 16, 1, stored<std::uint16_t>({1, 65535})));
    EXPECT_EQ(words.image.data, (PixelData{1 / 65535.0f, 1}));
    EXPECT_EQ(words.sample, "16 bit");
    const TiffImage longs = read(madeTiff(2, 1, 1, 32, 1, stored<std::uint32_t>({0x80000000u, 0xffffffffu})));
    EXPECT_FLOAT_EQ(longs.image.data[0], 0.5f);
    EXPECT_EQ(longs.image.data[1], 1);
    const TiffImage reals = read(madeTiff(1, 2, 3, 32, 3, stored<float>({0.1f, -2, 1e30f, 4, 5, 6})));
    EXPECT_EQ(reals.image.components, 3);
    EXPECT_EQ(reals.image.data, (PixelData{0.1f, -2, 1e30f, 4, 5, 6}));
    EXPECT_EQ(reals.sample, "float");
    EXPECT_TRUE(reals.linear);
    const TiffImage halves = read(madeTiff(2, 1, 1, 16, 3, stored<std::uint16_t>({0x3c00, 0xc000})));
    EXPECT_EQ(halves.image.data, (PixelData{1, -2}));
    EXPECT_EQ(halves.sample, "half");
}

TEST(Tiff, RowsAndColumnsStandWhereTheOrientationSays) {
    const std::vector<float> values{1, 2, 3, 4, 5, 6};  // 3 x 2
    const std::map<std::uint32_t, PixelData> expected{
        {1, {1, 2, 3, 4, 5, 6}}, {2, {3, 2, 1, 6, 5, 4}}, {3, {6, 5, 4, 3, 2, 1}}, {4, {4, 5, 6, 1, 2, 3}},
        {5, {1, 4, 2, 5, 3, 6}}, {6, {4, 1, 5, 2, 6, 3}}, {7, {6, 3, 5, 2, 4, 1}}, {8, {3, 6, 2, 5, 1, 4}}};
    for (const auto& [orientation, data] : expected) {
        MadeTiff file = madeTiff(3, 2, 1, 32, 3, stored(values));
        file.tags[274] = orientation;
        const Image image = read(file).image;
        EXPECT_EQ(image.data, data) << orientation;
        EXPECT_EQ(image.width, orientation < 5 ? 3 : 2) << orientation;
    }
}

TEST(Tiff, WhiteMayBeZero) {
    MadeTiff file = madeTiff(2, 1, 1, 8, 1, stored<std::uint8_t>({0, 255}));
    file.tags[262] = 0;
    EXPECT_EQ(read(file).image.data, (PixelData{1, 0}));
    EXPECT_EQ(read(file).notes.lines, std::vector<std::string>{"its values are inverted: 0 is white in it"});
    for (unsigned code = 0; code < 256; ++code) {
        file.strip[0] = static_cast<char>(code);
        EXPECT_EQ(read(file).image.data[0], static_cast<float>(255 - code) / 255.0f) << code;
    }
    MadeTiff seen = madeTiff(2, 1, 2, 8, 1, stored<std::uint8_t>({0, 51, 255, 255}));
    seen.tags[262] = 0;
    seen.tags[338] = 2;
    EXPECT_EQ(read(seen).image.data, (PixelData{1, 51 / 255.0f, 0, 1})) << "alpha is not turned over";
}

TEST(Tiff, IsAnImageFileLikeOthers) {
    const std::string bytes = madeTiff(1, 1, 3, 8, 1, stored<std::uint8_t>({255, 0, 51})).bytes();
    const ImageFile file = readImage(std::as_bytes(std::span(bytes)), "whatever.png");
    EXPECT_EQ(file.format, "TIFF");
    EXPECT_TRUE(file.display_referred);
    ASSERT_EQ(file.layers.size(), 1u);
    EXPECT_EQ(file.layers[0].channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(file.layers[0].sample, "8 bit");
    EXPECT_EQ(file.layers[0].image.data, (PixelData{1, 0, 51 / 255.0f}));
}

TEST(Tiff, WhatIsNotReadIsNamedInOneLine) {
    const MadeTiff sound = madeTiff(2, 2, 1, 8, 1, std::string(4, 'x'));
    struct Case {
        int tag;
        std::uint32_t value;
        const char* said;
    };
    for (const Case& wrong : {Case{259, 7, "compression 7"}, Case{262, 5, "photometric interpretation 5"},
                              Case{258, 4, "4-bit samples"}, Case{339, 2, "format 2"},
                              Case{277, 4, "4 samples"}, Case{256, 70000, "70000 x 2 pixels"},
                              Case{257, 60000, "too many for its"}, Case{256, 0, "a.tif"}}) {
        MadeTiff file = sound;
        file.tags[wrong.tag] = wrong.value;
        const std::string fault = tiffFault(file.bytes());
        EXPECT_NE(fault.find(wrong.said), std::string::npos) << wrong.tag << ": " << fault;
        EXPECT_EQ(fault.find('\n'), std::string::npos);
    }
    MadeTiff alpha = sound;  // with grey: two samples per pixel
    alpha.tags[277] = 2;
    alpha.strip.resize(8, 'x');
    alpha.tags[279] = 8;
    EXPECT_EQ(tiffFault(alpha.bytes()), "");
    EXPECT_NE(tiffFault(sound.bytes(), 8).find("a.tif: "), std::string::npos) << "more memory than allowed";
}

}  // namespace
}  // namespace diptych
