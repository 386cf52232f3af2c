// SPDX-License-Identifier: MIT
// WebP images of every kind, written by libwebp, decode to the stored numbers.
#include "shared/scene/image/decode.h"
#include "tests/support/errors.h"
#include "tests/support/webp_builder.h"

#include <gtest/gtest.h>
#include <webp/decode.h>

#include <span>
#include <stdexcept>
#include <string>

using namespace diptych;

namespace {

TextureImage decodedWebp(const std::string& file) {
    return decodeImage({reinterpret_cast<const unsigned char*>(file.data()), file.size()});
}

std::string webpFault(const std::string& file) {
    return faultOf([&] { decodedWebp(file); });
}

// Replaces the bytes at `at`.
std::string patchedWebp(std::string file, std::size_t at, const std::string& bytes) {
    return file.replace(at, bytes.size(), bytes);
}

}  // namespace

TEST(WebpDecode, LosslessPixelsAreTheWrittenOnes) {
    for (const bool opaque : {false, true}) {
        const WebpPixels written = colourfulWebp(37, 21, opaque);
        const TextureImage image = decodedWebp(losslessWebp(written));
        EXPECT_EQ(image.width, 37);
        EXPECT_EQ(image.height, 21);
        EXPECT_EQ(image.rgba, written.rgba);
        EXPECT_TRUE(image.rgba16.empty());
    }
}

// The library's own function for whole images has the same upsampling and filters.
TEST(WebpDecode, LossyPixelsAreLibwebps) {
    for (const bool opaque : {false, true}) {
        const std::string file = lossyWebp(colourfulWebp(37, 21, opaque));
        EXPECT_EQ(file.find("ALPH") == file.npos, opaque);
        int width = 0, height = 0;
        std::uint8_t* expected =
            WebPDecodeRGBA(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), &width, &height);
        ASSERT_NE(expected, nullptr);
        EXPECT_EQ(decodedWebp(file).rgba,
                  std::vector<std::uint8_t>(expected, expected + std::size_t{4} * 37 * 21));
        WebPFree(expected);
    }
}

// Only the colour transform rounds. Alpha is always lossless at the default alpha quality.
TEST(WebpDecode, LossyImagesOfOneColourKeepIt) {
    for (const std::uint8_t alpha : {std::uint8_t{40}, std::uint8_t{255}}) {
        const TextureImage image = decodedWebp(lossyWebp(plainWebp(16, 16, {200, 100, 50, alpha}), 100));
        ASSERT_EQ(image.rgba.size(), 4u * 256);
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            EXPECT_NEAR(image.rgba[i], 200, 3);
            EXPECT_NEAR(image.rgba[i + 1], 100, 3);
            EXPECT_NEAR(image.rgba[i + 2], 50, 3);
            EXPECT_EQ(image.rgba[i + 3], alpha);
        }
    }
}

// glTF 2.0, 3.8.3.
TEST(WebpDecode, ColourProfilesChangeNothing) {
    const WebpPixels written = colourfulWebp(5, 3, true);
    const std::string pixels = losslessWebp(written).substr(12);
    const std::string file =
        webpFile(webpHeader(32, 5, 3) + webpChunk("ICCP", "not a profile") + pixels + webpChunk("EXIF", "x"));
    EXPECT_EQ(decodedWebp(file).rgba, written.rgba);
}

TEST(WebpDecode, AnimationsAreRefusedByName) {
    EXPECT_EQ(webpFault(animatedWebp(colourfulWebp(5, 3, true))),
              "is an animated WebP, which is not supported; use a still image");
}

// The container's lengths agree with the file, the image's do not.
TEST(WebpDecode, ImagesThatEndWithinTheirChunkAreRefused) {
    for (const std::string& file :
         {losslessWebp(colourfulWebp(37, 21, true)), lossyWebp(colourfulWebp(37, 21, true))}) {
        const std::string chunk = file.substr(20);
        const std::string whole = webpFile(webpChunk(file.substr(12, 4), chunk)),
                          half = webpFile(webpChunk(file.substr(12, 4), chunk.substr(0, chunk.size() / 2)));
        EXPECT_EQ(webpFault(whole), "");
        EXPECT_TRUE(webpFault(half).starts_with("does not decode: ")) << webpFault(half);
    }
}

// Sizes are checked before allocation. RFC 6386, 9.1: 14 bits for each side of a lossy image, at byte 26
// of a simple file. A lossless image of one colour takes no bits per pixel and may have any size.
TEST(WebpDecode, ClaimsThatNoFileOfItsLengthCanHold) {
    const std::string lossy = lossyWebp(plainWebp(16, 16, {1, 2, 3, 255}));
    EXPECT_EQ(webpFault(patchedWebp(lossy, 26, "\xff\x3f\xff\x3f")),
              "claims 16383 x 16383 pixels, too many for its " + std::to_string(lossy.size()) + " bytes");
    const std::string alone = webpFile(webpHeader(16, 16385, 1));
    EXPECT_EQ(webpFault(alone), "has 16385 x 1 pixels; each side must be 1 to 16384");
    EXPECT_EQ(webpFault(webpFile(webpHeader(16, 16384, 16384))),
              "claims 16384 x 16384 pixels, too many for its " + std::to_string(alone.size()) + " bytes");
    const WebpPixels grey = plainWebp(1000, 1000, {77, 77, 77, 255});
    const std::string small = losslessWebp(grey);
    EXPECT_LT(small.size(), 200u);
    EXPECT_EQ(decodedWebp(small).rgba, grey.rgba);
    EXPECT_EQ(decodedWebp(lossyWebp(grey)).width, 1000) << "no encoder goes below the bound of lossy images";
}
