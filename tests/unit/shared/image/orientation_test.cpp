// SPDX-License-Identifier: MIT
// Exif orientation in JPEG and PNG files, rotated as viewers show them.
#include "shared/image/orientation.h"
#include "shared/image/image_file.h"
#include "tests/support/png_builder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace diptych {
namespace {

std::string number(std::uint32_t value, int bytes, bool big) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += static_cast<char>(value >> (8 * (big ? bytes - 1 - i : i)) & 0xff);
    return text;
}

// An Exif block with one other entry and the orientation.
std::string exif(std::uint32_t orientation, bool big, std::uint32_t type = 3) {
    const auto entry = [&](std::uint32_t tag, std::uint32_t kind, std::uint32_t value) {
        return number(tag, 2, big) + number(kind, 2, big) + number(1, 4, big) + number(value, 2, big) +
               number(0, 2, big);
    };
    return (big ? "MM" : "II") + number(42, 2, big) + number(8, 4, big) + number(2, 2, big) +
           entry(0x0103, 3, 1) + entry(0x0112, type, orientation) + number(0, 4, big);
}

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

TEST(Orientation, IsReadInBothByteOrders) {
    for (const bool big : {false, true})
        for (std::uint32_t orientation = 1; orientation <= 8; ++orientation)
            EXPECT_EQ(orientationOf(bytesOf(exif(orientation, big))), static_cast<int>(orientation));
}

// Truncated data, or values that are no orientation.
TEST(Orientation, WhatSaysNothingIsUpright) {
    for (const std::uint32_t wrong : {0u, 9u, 65535u})
        EXPECT_EQ(orientationOf(bytesOf(exif(wrong, true))), 1);
    EXPECT_EQ(orientationOf(bytesOf(exif(6, false, 4))), 1) << "of another type";
    const std::string whole = exif(6, false);
    for (std::size_t size = 0; size < whole.size() - 6; ++size)
        EXPECT_EQ(orientationOf(bytesOf(whole.substr(0, size))), 1) << size;
    EXPECT_EQ(orientationOf(bytesOf("II*" + std::string(1, 0) + number(0xffffffff, 4, false))), 1);
}

TEST(Orientation, IsFoundInAJpeg) {
    using namespace std::string_literals;
    const auto segment = [](char marker, const std::string& data) {
        return "\xff"s + marker + number(static_cast<std::uint32_t>(data.size() + 2), 2, true) + data;
    };
    const std::string start = "\xff\xd8"s, other = segment('\xe0', "JFIF"),
                      found = segment('\xe1', "Exif\0\0"s + exif(8, true)), scan = segment('\xda', "");
    EXPECT_EQ(orientationOfJpeg(bytesOf(start + other + "\xff" + found + scan)), 8) << "behind a fill byte";
    EXPECT_EQ(orientationOfJpeg(bytesOf(start + segment('\xe1', "http://ns.adobe.com/xap") + found)), 8);
    EXPECT_EQ(orientationOfJpeg(bytesOf(start + scan + found)), 1) << "in the picture's own data";
    for (std::size_t size = 0; size < start.size() + found.size() - 10; ++size)
        EXPECT_EQ(orientationOfJpeg(bytesOf((start + found).substr(0, size))), 1) << size;
}

// 2 x 1: red, green; the Exif chunk is behind the pixels.
TEST(Orientation, APngIsTurned) {
    MadePng made;
    made.width = 2;
    made.rows = {{255, 0, 0, 0, 255, 0}};
    made.exif = exif(6, true);
    const std::string png = pngOf(made);
    EXPECT_EQ(orientationOfPng(bytesOf(png)), 6);
    for (const EightBits eight : {EightBits::decoded, EightBits::kept}) {
        const ImageFile shown = readImage(bytesOf(png), "b.png", {}, limits::imageBytes(), eight);
        EXPECT_EQ(shown.width, 1);
        EXPECT_EQ(shown.height, 2);
        EXPECT_EQ(imageSize(bytesOf(png), "b.png", {}, eight).height, 2);
        const ImageLayer& layer = shown.layers.front();
        if (eight == EightBits::kept)
            EXPECT_EQ(layer.coded.data, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0}));
        else
            EXPECT_EQ(layer.image.height, 2);
    }
}

}  // namespace
}  // namespace diptych
