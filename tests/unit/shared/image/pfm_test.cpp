// SPDX-License-Identifier: MIT
// PFM files made by hand: both types, both byte orders, rows from the bottom; and files with wrong
// headers.
#include "shared/image/pfm.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

using namespace std::string_literals;
using Values = PixelData;

std::string little(const Values& values) {
    return {reinterpret_cast<const char*>(values.data()), 4 * values.size()};
}
std::string big(const Values& values) {
    std::string bytes = little(values);
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
        std::swap(bytes[i], bytes[i + 3]);
        std::swap(bytes[i + 1], bytes[i + 2]);
    }
    return bytes;
}

PfmImage pfmOf(const std::string& file, std::uint64_t max = limits::imageBytes()) {
    return readPfm(std::as_bytes(std::span(file)), "a.pfm", max);
}
std::string pfmFault(const std::string& file, std::uint64_t max = limits::imageBytes()) {
    return faultOf([&] { pfmOf(file, max); });
}

TEST(Pfm, RowsAreStoredFromTheBottom) {
    const Image grey = pfmOf("Pf\n2 3\n-1.0\n" + little({1, 2, 3, 4, 5, 6})).image;
    ASSERT_EQ(grey.components, 1);
    ASSERT_EQ(grey.width, 2);
    EXPECT_EQ(grey.data, (Values{5, 6, 3, 4, 1, 2}));
    const Image color = pfmOf("PF\n1 2\n-1\n" + little({1, 2, 3, 4, 5, 6})).image;
    ASSERT_EQ(color.components, 3);
    EXPECT_EQ(color.data, (Values{4, 5, 6, 1, 2, 3}));
}

TEST(Pfm, TheScalesSignIsTheByteOrderAndItsSizeAFactor) {
    const Values stored{1, -2, 0.5f};
    EXPECT_EQ(pfmOf("PF\n1 1\n1.0\n" + big(stored)).image.data, stored);
    EXPECT_EQ(pfmOf("PF\n1 1\n+1e0\n" + big(stored)).image.data, stored);
    EXPECT_EQ(pfmOf("PF\n1 1\n-0.5\n" + little(stored)).image.data, (Values{0.5f, -1, 0.25f}));
    EXPECT_EQ(pfmOf("PF\n1 1\n4\n" + big(stored)).image.data, (Values{4, -8, 2}));
    EXPECT_EQ(pfmOf("PF\n1 1\n-0.5\n" + little(stored)).scale, 0.5f) << "for a note";
}

TEST(Pfm, OneBlankEndsTheHeader) {
    // A byte 0x0a at the beginning of the data belongs to the number.
    const float value = std::bit_cast<float>(0x3f80000au);
    EXPECT_EQ(pfmOf("Pf 1 1 -1 " + little({value})).image.data, Values{value});
    EXPECT_EQ(pfmOf("Pf\r\n1\t1\n\n-1\n" + little({value})).image.data, Values{value});
}

TEST(Pfm, ALineMayEndInCrLf) {
    const float value = std::bit_cast<float>(0x3f80000au);
    const PfmImage image = pfmOf("Pf\r\n1 1\r\n-1\r\n" + little({value}));
    EXPECT_EQ(image.image.data, Values{value});
    EXPECT_EQ(image.behind, 0u);
    EXPECT_EQ(pfmOf("Pf\r\n1 1\r\n-1\r" + little({value})).image.data, Values{value});
}

TEST(Pfm, BytesBehindThePixelsAreCounted) {
    EXPECT_EQ(pfmOf("Pf\n1 1\n-1\n" + little({1})).behind, 0u);
    EXPECT_EQ(pfmOf("Pf\n1 1\n-1\n" + little({1}) + "\nx").behind, 2u);
}

TEST(Pfm, EveryBitComesBack) {
    const std::filesystem::path file = folder() / "a.pfm";
    for (const int components : {1, 3}) {
        Image image(3, 2, components);
        for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.37f * static_cast<float>(i) - 1;
        image.data[0] = std::numeric_limits<float>::quiet_NaN();
        image.data[1] = -std::numeric_limits<float>::infinity();
        image.data[2] = std::numeric_limits<float>::denorm_min();
        image.data[3] = -0.0f;
        writePfm(file, image);
        const std::string bytes = contentsOf(file);
        EXPECT_TRUE(bytes.starts_with(components == 1 ? "Pf\n3 2\n-1.0\n" : "PF\n3 2\n-1.0\n"));
        const PfmImage back = pfmOf(bytes);
        EXPECT_EQ(back.behind, 0u);
        ASSERT_EQ(back.image.data.size(), image.data.size());
        for (std::size_t i = 0; i < image.data.size(); ++i)
            EXPECT_EQ(std::bit_cast<std::uint32_t>(back.image.data[i]),
                      std::bit_cast<std::uint32_t>(image.data[i]))
                << i;
    }
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.pfm"});
    EXPECT_THROW(writePfm(file, Image(2, 2, 4)), std::runtime_error);
    EXPECT_THROW(writePfm(file, Image()), std::runtime_error);
}

TEST(Pfm, FaultsAreNamed) {
    const std::string pixel = little({1, 2, 3});
    EXPECT_EQ(pfmFault("P6\n1 1\n255\nabc"), "a.pfm: is not a PFM: it begins with \"P6\", not PF or Pf");
    EXPECT_EQ(pfmFault("PF\x01\n1 1\n-1\n"), "a.pfm: is not a PFM: it begins with \"PF?\", not PF or Pf");
    for (const char* cut : {"", "PF", "PF\n", "PF\n1", "PF\n1 1\n", "PF\n1 1\n-1"})
        EXPECT_EQ(pfmFault(cut), "a.pfm: its header is cut short") << cut;
    EXPECT_EQ(pfmFault("PF\n" + std::string(65, '1') + " 1\n-1\n"),
              "a.pfm: \"" + std::string(40, '1') + "...\" in its header is too long");
    EXPECT_EQ(pfmFault("PF\n1x 1\n-1\n" + pixel), "a.pfm: its width is \"1x\", not a number");
    EXPECT_EQ(pfmFault("PF\n1 1.5\n-1\n" + pixel), "a.pfm: its height is \"1.5\", not a number");
    EXPECT_EQ(pfmFault("PF\n1 99999999999\n-1\n" + pixel),
              "a.pfm: its height is \"99999999999\", not a number");
    EXPECT_EQ(pfmFault("PF\n1 1\none\n" + pixel), "a.pfm: its scale is \"one\", not a number");
    for (const char* scale : {"0", "-0.0", "nan", "inf", "1e-40"})
        EXPECT_EQ(pfmFault("PF\n1 1\n"s + scale + "\n" + pixel),
                  "a.pfm: its scale is "s + scale + ", not a normal number");
    EXPECT_EQ(pfmFault("PF\n0 1\n-1\n" + pixel), "a.pfm: claims 0 x 1 pixels; each side must be 1 to 65536");
    EXPECT_EQ(pfmFault("PF\n-1 -1\n-1\n" + pixel),
              "a.pfm: claims -1 x -1 pixels; each side must be 1 to 65536");
    EXPECT_EQ(pfmFault("PF\n65537 1\n-1\n" + pixel),
              "a.pfm: claims 65537 x 1 pixels; each side must be 1 to 65536");
    EXPECT_EQ(pfmFault("PF\n1 1\n-1\n" + pixel, 11),
              "a.pfm: claims 1 x 1 pixels of 12 bytes; the limit is 0 MiB");
    EXPECT_EQ(pfmFault("PF\n2 1\n-1\n" + pixel),
              "a.pfm: is cut short: 2 x 1 pixels need 24 bytes, but it has 12");
}

}  // namespace
}  // namespace diptych
