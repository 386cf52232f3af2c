// SPDX-License-Identifier: MIT
// Radiance images made by hand: every orientation, both run-length codes, and files with wrong headers.
#include "shared/image/radiance.h"
#include "shared/image/atomic_file.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

using namespace std::string_literals;

// Header up to the empty line, resolution, pixels.
std::string hdr(const std::string& resolution, const std::string& pixels, const std::string& variables = "") {
    return "#?RADIANCE\n" + variables + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + pixels;
}
Image radianceOf(const std::string& file) {
    return readHdr(std::as_bytes(std::span(file)), "a.hdr").image;
}
std::string radianceFault(const std::string& file, std::uint64_t max = limits::imageBytes()) {
    return faultOf([&] { readHdr(std::as_bytes(std::span(file)), "a.hdr", max); });
}

TEST(Radiance, AMantissaIsTheMiddleOfItsStep) {
    // Exponent 129 is 2^1; a mantissa m is (m + 1/2) / 256 of that.
    const Image image = radianceOf(hdr("-Y 1 +X 2", "\x80\x40\x00\x81\x09\x09\x09\x00"s));
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 1);
    ASSERT_EQ(image.components, 3);
    EXPECT_EQ(image.data, (PixelData{1.00390625f, 0.50390625f, 0.00390625f, 0, 0, 0}));
}

TEST(Radiance, ExposuresAreTakenOutAgain) {
    const Image image =
        radianceOf(hdr("-Y 1 +X 1", "\x80\x80\x80\x81",
                       "# a note\nEXPOSURE=2\nVIEW= -vtv\nEXPOSURE= 4.0 \nCOLORCORR=1 0.5 4\n"));
    EXPECT_EQ(image.data, (PixelData{1.00390625f / 8, 1.00390625f / 4, 1.00390625f / 32}));
    for (const char* bad : {"0", "-1", "nan", "inf", "one", "1 2x"})
        EXPECT_EQ(radianceFault(hdr("-Y 1 +X 1", "\x80\x80\x80\x81", "COLORCORR=1 "s + bad + "\n")),
                  "a.hdr: COLORCORR=1 "s + bad + " is not three numbers above 0")
            << bad;
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 1", "\x80\x80\x80\x81", "EXPOSURE=1e-9\n")),
              "a.hdr: EXPOSURE and COLORCORR scale its values beyond the range of float");
}

// An image of 3 x 2; pixel i, in rows from the top left, has the mantissa 128 + i.
TEST(Radiance, EveryOrderOfTheEight) {
    struct Order {
        const char* resolution;
        std::string stored;
    };
    for (const auto& [resolution, stored] :
         {Order{"-Y 2 +X 3", "012345"}, Order{"-Y 2 -X 3", "210543"}, Order{"+Y 2 +X 3", "345012"},
          Order{"+Y 2 -X 3", "543210"}, Order{"+X 3 -Y 2", "031425"}, Order{"-X 3 -Y 2", "251403"},
          Order{"+X 3 +Y 2", "304152"}, Order{"-X 3 +Y 2", "524130"}}) {
        std::string pixels;
        for (const char c : stored) pixels += std::string{static_cast<char>(128 + c - '0'), 0, 0, '\x80'};
        const Image image = radianceOf(hdr(resolution, pixels));
        ASSERT_EQ(image.width, 3) << resolution;
        ASSERT_EQ(image.height, 2) << resolution;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(image.at(i % 3, i / 3), (128.5f + static_cast<float>(i)) / 256)
                << resolution << " pixel " << i;
    }
}

TEST(Radiance, OldRunsInARowAreDigits) {
    // One pixel, 43 more, 1 x 256 more: 300. Then a single pixel, which restarts the digits, and a run of
    // 299.
    const std::string first = "\x80\x00\x00\x81\x01\x01\x01\x2b\x01\x01\x01\x01"s;
    const std::string second = "\xc0\x00\x00\x81\x01\x01\x01\x2b\x01\x01\x01\x01"s;
    const Image image = radianceOf(hdr("-Y 2 +X 300", first + second));
    for (int x = 0; x < 300; ++x) {
        EXPECT_EQ(image.at(x, 0), 128.5f / 128);
        EXPECT_EQ(image.at(x, 1), 192.5f / 128);
    }
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 300", "\x80\x00\x00\x81\x01\x01\x01\x2c\x01\x01\x01\x01"s)),
              "a.hdr: a run is longer than its line");
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 300", "\x01\x01\x01\x2c"s)), "a.hdr: a line begins with a run");
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 300", "\x80\x00\x00\x81"s + "\x01\x01\x01\x00\x01\x01\x01\x00"s +
                                                   "\x01\x01\x01\x00\x01\x01\x01\x00"s)),
              "a.hdr: a run is longer than its line")
        << "four digits are more than any line";
}

TEST(Radiance, NewRunsAreByComponent) {
    // Eight pixels: red is 8 x 200, green 1 to 8, blue 3 x 5 and 5 x 6, the exponent 8 x 128.
    const std::string line =
        "\x02\x02\x00\x08\x88\xc8\x08\x01\x02\x03\x04\x05\x06\x07\x08\x83\x05\x85\x06\x88\x80"s;
    const Image image = radianceOf(hdr("-Y 1 +X 8", line));
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(image.at(x, 0, 0), 200.5f / 256);
        EXPECT_EQ(image.at(x, 0, 1), (1.5f + static_cast<float>(x)) / 256);
        EXPECT_EQ(image.at(x, 0, 2), (x < 3 ? 5.5f : 6.5f) / 256);
    }
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 9", line)), "a.hdr: a line has 8 pixels instead of 9");
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 8", "\x02\x02\x00\x08\x89\xc8"s)),
              "a.hdr: a run is longer than its line");
    EXPECT_EQ(radianceFault(hdr("-Y 1 +X 8", "\x02\x02\x00\x08\x00\xc8"s)),
              "a.hdr: a run is longer than its line");
}

TEST(Radiance, FaultsAreNamed) {
    const std::string pixel = "\x80\x80\x80\x81";
    EXPECT_EQ(radianceFault(""), "a.hdr: is not a Radiance picture: it does not begin with #?");
    EXPECT_EQ(radianceFault("#?RADIANCE"), "a.hdr: its header has no end");
    EXPECT_EQ(radianceFault("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel),
              "a.hdr: FORMAT 32-bit_rle_xyze (CIE XYZ) is not supported; use 32-bit_rle_rgbe");
    EXPECT_EQ(radianceFault("#?RADIANCE\nFORMAT=a\x01thing\n\n-Y 1 +X 1\n" + pixel),
              "a.hdr: FORMAT a?thing is not 32-bit_rle_rgbe");
    for (const char* bad :
         {"", "-Y 1", "-Y 1 -Y 1", "Y 1 X 1", "-Y 1 +X", "-Y 1 +X 1 1", "-Y 1.5 +X 1", "-Z 1 +X 1"})
        EXPECT_EQ(radianceFault(hdr(bad, pixel)),
                  "a.hdr: resolution \""s + bad + "\" is not like -Y 480 +X 640");
    EXPECT_EQ(radianceFault(hdr("-Y 0 +X 1", pixel)),
              "a.hdr: claims 1 x 0 pixels; each side must be 1 to 65536");
    EXPECT_EQ(radianceFault(hdr("-Y 70000 +X 1", pixel)),
              "a.hdr: claims 1 x 70000 pixels; each side must be 1 to 65536");
    EXPECT_EQ(radianceFault(hdr("-Y 99999999999 +X 1", pixel)),
              "a.hdr: resolution \"-Y 99999999999 +X 1\" is not like -Y 480 +X 640");
    const std::string huge = hdr("-Y 20000 +X 20000", pixel);
    EXPECT_EQ(radianceFault(huge), "a.hdr: claims 20000 x 20000 pixels, too many for its " +
                                       std::to_string(huge.size()) + " bytes");
    EXPECT_EQ(radianceFault(hdr("-Y 20 +X 20", pixel), 4799),
              "a.hdr: claims 20 x 20 pixels of 12 bytes; the limit is 0 MiB");
    // 65536 lines of one run each would expand 786 kB to 48 GiB; the first one is truncated.
    EXPECT_EQ(radianceFault(hdr("-Y 5000 +X 65536", std::string(40000, '\x03'))), "a.hdr: is cut short")
        << "walked through before 3.7 GiB are taken";
}

TEST(Radiance, WrittenImagesComeBackWithinAStep) {
    const std::filesystem::path file = folder() / "a.hdr";
    // Widths below and within the run-length code's range, runs of every length, single pixels, large and
    // small numbers.
    for (const int width : {1, 7, 8, 500}) {
        Image image(width, 3, 3);
        for (int i = 0; i < width * 3; ++i) {
            float* rgb = image.pixel(static_cast<std::size_t>(i));
            rgb[0] = std::ldexp(1.0f + 0.01f * static_cast<float>(i / (1 + i % 9)), i % 60 - 30);
            rgb[1] = i % 40 < 20 ? 0.25f : 3.0f * static_cast<float>(i);
        }
        EXPECT_EQ(writeHdr(file, image), 0u);
        const Image back = readImage(file).layers[0].image;
        ASSERT_EQ(back.width, width);
        ASSERT_EQ(back.height, 3);
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            const float* a = image.pixel(i);
            const float* b = back.pixel(i);
            // Half a step of a mantissa of at least 128, relative to the largest component.
            const float step = std::max({a[0], a[1], a[2]}) / 256;
            for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(a[c] - b[c]), step) << i;
        }
        const std::string once = contentsOf(file);
        EXPECT_EQ(writeHdr(file, back), 0u);
        EXPECT_EQ(contentsOf(file), once) << "what has been through RGBE stays";
    }
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.hdr"});
}

TEST(Radiance, WhatRgbeCannotHoldIsCounted) {
    const std::filesystem::path file = folder() / "a.hdr";
    Image image(5, 1, 3, 1.0f);
    image.at(0, 0, 0) = -1;
    image.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 0, 2) = std::numeric_limits<float>::infinity();
    for (int c = 0; c < 3; ++c) image.at(3, 0, c) = 1e-40f;
    EXPECT_EQ(writeHdr(file, image), 4u);
    const Image back = readImage(file).layers[0].image;
    EXPECT_NEAR(back.at(0, 0, 0), 0, 1.0 / 128);
    EXPECT_NEAR(back.at(1, 0, 1), 0, 1.0 / 128);
    EXPECT_EQ(back.at(2, 0, 2), std::ldexp(255.5f, 119)) << "the largest number of RGBE";
    EXPECT_EQ(back.at(3, 0, 0), 0);
    EXPECT_EQ(back.at(4, 0, 0), 128.5f / 128);
    EXPECT_THROW(writeHdr(file, Image(2, 2, 4)), std::runtime_error);
    EXPECT_THROW(readImage(file.parent_path() / "none.hdr"), std::runtime_error);
}

}  // namespace
}  // namespace diptych
