// SPDX-License-Identifier: MIT
#include "shared/scene/image/mipmap.h"

#include "shared/image/srgb.h"
#include "tests/support/srgb.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>

using namespace diptych;

namespace {

TextureImage image(int width, int height, auto texel) {
    TextureImage result{"", width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c) result.rgba.push_back(static_cast<std::uint8_t>(texel(x, y, c)));
    return result;
}

TextureImage noiseTexture(int width, int height) {
    std::mt19937 random(1);
    return image(width, height, [&](int, int, int) { return random() & 255u; });
}

TextureImage deepImage(int width, int height, std::vector<std::uint16_t> codes) {
    return {"", width, height, {}, std::move(codes)};
}

// Levels of a mip chain as components of T.
template <class T>
std::vector<std::vector<T>> levels(const TextureImage& image, bool srgb, Texels texels) {
    const MipChain chain(image, srgb, texels);
    std::vector<std::vector<T>> result;
    for (std::size_t i = 0; i < chain.count(); ++i) {
        EXPECT_EQ(chain.level(i).size(), bytesPerTexel(texels) * static_cast<std::size_t>(chain.width(i)) *
                                             static_cast<std::size_t>(chain.height(i)));
        result.emplace_back(chain.level(i).size() / sizeof(T));
        std::memcpy(result.back().data(), chain.level(i).data(), chain.level(i).size());
    }
    return result;
}

std::vector<std::vector<std::uint8_t>> levels(const TextureImage& image, bool srgb) {
    return levels<std::uint8_t>(image, srgb, srgb ? Texels::srgb8 : Texels::linear8);
}

double mean(const std::vector<std::uint8_t>& texels, std::size_t component) {
    double sum = 0;
    for (std::size_t i = component; i < texels.size(); i += 4) sum += texels[i];
    return sum / (static_cast<double>(texels.size()) / 4);
}

}  // namespace

// Half the light of white is linear 0.5: sRGB 1.055 * 0.5^(1/2.4) - 0.055 = 0.73536, times 255 = 187.5 ->
// 188. Alpha is never sRGB: (0 + 255 + 255 + 0) / 4 = 127.5 -> 128.
TEST(Mipmap, CheckerIsAveragedInLinearLight) {
    const TextureImage checker = image(2, 2, [](int x, int y, int) { return (x + y) % 2 ? 255 : 0; });
    const auto srgb = levels(checker, true), linear = levels(checker, false);
    ASSERT_EQ(srgb.size(), 2u);
    EXPECT_EQ(srgb[1], (std::vector<std::uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(linear[1], (std::vector<std::uint8_t>{128, 128, 128, 128}));
}

TEST(Mipmap, SizesHalveRoundedDownToOne) {
    const TextureImage source = noiseTexture(5, 3);
    const MipChain chain(source, true, Texels::srgb8);
    ASSERT_EQ(chain.count(), 3u);
    EXPECT_EQ(chain.width(1), 2);
    EXPECT_EQ(chain.height(1), 1);
    EXPECT_EQ(chain.width(2), 1);
    EXPECT_EQ(chain.height(2), 1);
    EXPECT_EQ(levels(noiseTexture(1, 9), false).size(), 4u);
    EXPECT_EQ(levels(noiseTexture(1, 1), true).size(), 1u);
}

TEST(Mipmap, LevelZeroIsTheImage) {
    const TextureImage source = noiseTexture(7, 4);
    EXPECT_EQ(levels(source, true)[0], source.rgba);
}

// Thirds: (0 + 30 + 240) / 3 = 90 exactly.
TEST(Mipmap, ThreeByOneIsTheMeanOfAllThree) {
    const std::uint8_t values[] = {0, 30, 240};
    const auto chain = levels(image(3, 1, [&](int x, int, int) { return values[x]; }), false);
    ASSERT_EQ(chain.size(), 2u);
    EXPECT_EQ(chain[1], (std::vector<std::uint8_t>{90, 90, 90, 90}));
}

// Five texels become two, each covering 2.5: (a + b + c / 2) / 2.5 and (c / 2 + d + e) / 2.5.
TEST(Mipmap, FiveByOneIsWeightedByArea) {
    const std::uint8_t values[] = {10, 20, 40, 100, 250};
    const auto chain = levels(image(5, 1, [&](int x, int, int) { return values[x]; }), false);
    EXPECT_EQ(chain[1][0], 20);   // 50 / 2.5
    EXPECT_EQ(chain[1][4], 148);  // 370 / 2.5
    EXPECT_EQ(chain[2][0], 84);   // 420 / 5, from the unrounded level
}

// Every texel has the same weight in every level: the mean is preserved, up to each texel's rounding by
// half a step.
TEST(Mipmap, OddSizesConserveTheMean) {
    for (const auto& [width, height] : {std::pair{3, 1}, {5, 3}, {7, 7}, {1, 5}, {641, 359}}) {
        const TextureImage source = noiseTexture(width, height);
        for (const auto& level : levels(source, false))
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_NEAR(mean(level, c), mean(source.rgba, c), 0.5001) << width << "x" << height;
    }
}

// Every code survives decoding, summing with odd weights, rounding and encoding.
TEST(Mipmap, ConstantImagesStayConstant) {
    for (int value = 0; value < 256; ++value)
        for (const bool srgb : {false, true})
            for (const auto& level : levels(image(7, 6, [&](int, int, int) { return value; }), srgb))
                for (const std::uint8_t code : level) ASSERT_EQ(code, value) << srgb;
}

// Encoding rounds exactly: a pair of codes averages to the code nearest to the mean computed in double.
TEST(Mipmap, EncodingRoundsToTheNearestCode) {
    for (int a = 0; a < 256; a += 3)
        for (int b = 0; b < 256; ++b) {
            const auto chain = levels(image(2, 1, [&](int x, int, int) { return x ? b : a; }), true);
            const double exact = 255 * encodedSrgb((decodedSrgb(a / 255.0) + decodedSrgb(b / 255.0)) / 2);
            // 0.5, plus the effect of float weights and of the curve's gap (1e-7) between its two branches
            ASSERT_NEAR(chain[1][0], exact, 0.5 + 1e-3) << a << " " << b;
        }
}

TEST(Mipmap, AnyNumberOfThreadsGivesTheSameBits) {
    const TextureImage source = noiseTexture(517, 301);
    const auto many = levels(source, true);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = levels(source, true);
    ASSERT_EQ(many.size(), single.size());
    for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(many[i], single[i]) << i;
}

// ---- 16 bits -----------------------------------------------------------------------------------------

// One step of 16 bits: 1000 and 1001 average to 1000.5, which rounds up; alpha 0 and 65535 to 32768.
TEST(Mipmap, SixteenBitsKeepEveryStep) {
    const TextureImage source = deepImage(2, 1, {1000, 1001, 40000, 0, 1001, 1001, 40002, 65535});
    const auto chain = levels<std::uint16_t>(source, false, Texels::linear16);
    ASSERT_EQ(chain.size(), 2u);
    EXPECT_EQ(chain[0], source.rgba16);
    EXPECT_EQ(chain[1], (std::vector<std::uint16_t>{1001, 1001, 40001, 32768}));
}

// 16-bit sRGB codes as linear float32. Linear part: 655 / 65535 / 12.92. Above: ((32896 / 65535 + 0.055) /
// 1.055)^2.4 = 0.215861, as for 128 / 255 in 8 bits; one step more adds 1.42e-5. The next level is the
// mean in linear light.
TEST(Mipmap, SixteenBitsOfSrgbAreDecodedToFloats) {
    const TextureImage source = deepImage(2, 1, {655, 656, 32896, 65535, 655, 656, 32897, 0});
    const auto chain = levels<float>(source, true, Texels::float32);
    EXPECT_FLOAT_EQ(chain[0][0], 655 / 65535.0f / 12.92f);
    EXPECT_FLOAT_EQ(chain[0][1], 656 / 65535.0f / 12.92f);
    EXPECT_NEAR(chain[0][2], 0.2158605, 1e-7);
    EXPECT_NEAR(chain[0][6] - chain[0][2], 1.42e-5, 1e-7);
    EXPECT_EQ(chain[0][3], 1.0f);
    EXPECT_FLOAT_EQ(chain[1][0], chain[0][0]);
    EXPECT_FLOAT_EQ(chain[1][2], (chain[0][2] + chain[0][6]) / 2);
    EXPECT_EQ(chain[1][3], 0.5f);
}

// If a device can only filter floats: linear codes over 65535, and halves with 11 bits.
TEST(Mipmap, SixteenLinearBitsAsFloatsAndHalves) {
    const TextureImage source = deepImage(1, 1, {1000, 32768, 65535, 0});
    const auto floats = levels<float>(source, false, Texels::float32);
    EXPECT_EQ(floats[0], (std::vector<float>{1000 / 65535.0f, 32768 / 65535.0f, 1, 0}));
    const auto halves = levels<std::uint16_t>(source, false, Texels::float16);
    EXPECT_EQ(halves[0], (std::vector<std::uint16_t>{0x23d0, 0x3800, 0x3c00, 0}));  // 1000 / 65536
}

TEST(Mipmap, EverySixteenBitCodeStays) {
    std::vector<std::uint16_t> codes;
    for (int code = 0; code < 65536; ++code)
        for (int c = 0; c < 4; ++c) codes.push_back(static_cast<std::uint16_t>(code));
    // 2 x 2 texels with the same code are averaged to one.
    TextureImage source = deepImage(512, 512, {});
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            for (int c = 0; c < 4; ++c)
                source.rgba16.push_back(static_cast<std::uint16_t>(y / 2 * 256 + x / 2));
    EXPECT_EQ(levels<std::uint16_t>(source, false, Texels::linear16)[1], codes);
}

// An 8-bit code c is 257 c in 16 bits: c / 255 without rounding.
TEST(Mipmap, EightBitsBecomeSixteenExactly) {
    const TextureImage source = image(16, 16, [](int x, int y, int) { return 16 * y + x; });
    const auto codes = levels<std::uint16_t>(source, false, Texels::linear16);
    for (std::size_t code = 0; code < 256; ++code) EXPECT_EQ(codes[0][4 * code], 257 * code);
    // The mean of 0, 1, 16 and 17 is 8.5, which is not an 8-bit code.
    EXPECT_EQ(codes[1][0], (257 * 34 + 2) / 4);
}

// sRGB as half floats: decoded to the nearest half, alpha linear. Levels are means of unrounded values.
TEST(Mipmap, EightBitsOfSrgbBecomeTheNearestHalf) {
    const TextureImage source = image(16, 16, [](int x, int y, int) { return 16 * y + x; });
    const auto halves = levels<std::uint16_t>(source, true, Texels::float16);
    const auto floats = levels<float>(source, true, Texels::float32);
    for (std::size_t code = 0; code < 256; ++code) {
        const double exact = linearFromSrgb(static_cast<double>(code) / 255);
        EXPECT_NEAR(double{floats[0][4 * code]}, exact, exact * 0x1p-24) << code;
        EXPECT_EQ(halves[0][4 * code], glm::packHalf1x16(static_cast<float>(exact))) << code;
        EXPECT_EQ(halves[0][4 * code + 3], glm::packHalf1x16(static_cast<float>(code) / 255)) << code;
        EXPECT_NEAR(double{glm::unpackHalf1x16(halves[0][4 * code])}, exact, exact * 0x1p-11) << code;
    }
    double mean = 0;
    for (const int code : {0, 1, 16, 17}) mean += linearFromSrgb(code / 255.0) / 4;
    EXPECT_NEAR(double{floats[1][0]}, mean, mean * 0x1p-22);
    EXPECT_EQ(halves[1][0], glm::packHalf1x16(static_cast<float>(mean)));
}

TEST(Mipmap, TexelsThatTheImageHasNotAreALogicError) {
    EXPECT_THROW(MipChain(deepImage(1, 1, {0, 0, 0, 0}), false, Texels::linear8), std::logic_error);
    EXPECT_THROW(MipChain(deepImage(1, 1, {0, 0, 0, 0}), true, Texels::srgb8), std::logic_error);
    EXPECT_THROW(MipChain(TextureImage{"none", 1, 1, {}}, true, Texels::srgb8), std::logic_error);
}

// Each level's alpha is the other chain's component: unchanged at the same size. Larger levels magnify its
// first level with a linear filter; by hand, a texel's quarters are at 1/4 and 3/4 between two centres.
TEST(Mipmap, AnAlphaIsReplacedByAnotherChainsComponent) {
    const TextureImage large = noiseTexture(8, 4), small = noiseTexture(4, 2);
    for (const bool srgb : {true, false})
        for (const bool repeat : {true, false}) {
            const Texels texels = srgb ? Texels::srgb8 : Texels::linear8;
            MipChain chain(large, srgb, texels);
            const MipChain plain(large, srgb, texels), from(small, false, Texels::linear8);
            constexpr std::size_t blue = 2;
            chain.replaceAlpha(from, blue, repeat, repeat);
            ASSERT_EQ(chain.count(), 4u);
            for (std::size_t k = 0; k < chain.count(); ++k)
                for (std::size_t i = 0; i < chain.level(k).size(); ++i) {
                    if (i % 4 != 3) {
                        ASSERT_EQ(chain.level(k)[i], plain.level(k)[i]) << "colours stay";
                    } else if (k > 0) {
                        ASSERT_EQ(chain.level(k)[i], from.level(k - 1)[i - 3 + blue]) << k << ": " << i;
                    }
                }
            const auto code = [&](int x, int y) {
                const auto inside = [&](int k, int n) {
                    return repeat ? (k + n) % n : std::clamp(k, 0, n - 1);
                };
                const auto texel = static_cast<std::size_t>(inside(y, 2) * 4 + inside(x, 4));
                return static_cast<double>(small.rgba[4 * texel + blue]);
            };
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 8; ++x) {
                    const int i = (x + 1) / 2 - 1, j = (y + 1) / 2 - 1;
                    const double u = x % 2 == 0 ? 0.75 : 0.25, v = y % 2 == 0 ? 0.75 : 0.25;
                    const double expected = (code(i, j) * (1 - u) + code(i + 1, j) * u) * (1 - v) +
                                            (code(i, j + 1) * (1 - u) + code(i + 1, j + 1) * u) * v;
                    const auto got =
                        std::to_integer<int>(chain.level(0)[static_cast<std::size_t>(4 * (y * 8 + x) + 3)]);
                    EXPECT_LE(std::abs(got - expected), 0.5 + 1e-4) << x << ", " << y;
                }
        }
    MipChain chain(large, true, Texels::srgb8);
    EXPECT_THROW(chain.replaceAlpha(MipChain(noiseTexture(4, 4), false, Texels::linear8), 1, true, true),
                 std::logic_error);
    EXPECT_THROW(chain.replaceAlpha(MipChain(noiseTexture(16, 8), false, Texels::linear8), 1, true, true),
                 std::logic_error);
}
