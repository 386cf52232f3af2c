// SPDX-License-Identifier: MIT
#include "shared/scene/mipmap.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
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

TextureImage noise(int width, int height) {
    std::mt19937 random(1);
    return image(width, height, [&](int, int, int) { return random() & 255u; });
}

double mean(const TextureImage& image, std::size_t component) {
    double sum = 0;
    for (std::size_t i = component; i < image.rgba.size(); i += 4) sum += image.rgba[i];
    return sum / (static_cast<double>(image.rgba.size()) / 4);
}

}  // namespace

// Half of the light of white is linear 0.5: sRGB 1.055 * 0.5^(1/2.4) - 0.055 = 0.73536, times 255 = 187.5 ->
// 188. Alpha is never sRGB: (0 + 255 + 255 + 0) / 4 = 127.5 -> 128.
TEST(Mipmap, CheckerIsAveragedInLinearLight) {
    const TextureImage checker = image(2, 2, [](int x, int y, int) { return (x + y) % 2 ? 255 : 0; });
    const auto srgb = makeMipmaps(checker, true), linear = makeMipmaps(checker, false);
    ASSERT_EQ(srgb.size(), 2u);
    EXPECT_EQ(srgb[1].rgba, (std::vector<std::uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(linear[1].rgba, (std::vector<std::uint8_t>{128, 128, 128, 128}));
}

TEST(Mipmap, SizesHalveRoundedDownToOne) {
    const auto chain = makeMipmaps(noise(5, 3), true);
    ASSERT_EQ(chain.size(), 3u);
    EXPECT_EQ(chain[1].width, 2);
    EXPECT_EQ(chain[1].height, 1);
    EXPECT_EQ(chain[2].width, 1);
    EXPECT_EQ(chain[2].height, 1);
    EXPECT_EQ(makeMipmaps(noise(1, 9), false).size(), 4u);
    EXPECT_EQ(makeMipmaps(noise(1, 1), true).size(), 1u);
}

TEST(Mipmap, LevelZeroIsTheImage) {
    const TextureImage source = noise(7, 4);
    EXPECT_EQ(makeMipmaps(source, true)[0].rgba, source.rgba);
}

// Thirds: (0 + 30 + 240) / 3 = 90 exactly.
TEST(Mipmap, ThreeByOneIsTheMeanOfAllThree) {
    const std::uint8_t values[] = {0, 30, 240};
    const auto chain = makeMipmaps(image(3, 1, [&](int x, int, int) { return values[x]; }), false);
    ASSERT_EQ(chain.size(), 2u);
    EXPECT_EQ(chain[1].rgba, (std::vector<std::uint8_t>{90, 90, 90, 90}));
}

// Five texels become two of 2.5 each: (a + b + c / 2) / 2.5 and (c / 2 + d + e) / 2.5.
TEST(Mipmap, FiveByOneIsWeightedByArea) {
    const std::uint8_t values[] = {10, 20, 40, 100, 250};
    const auto chain = makeMipmaps(image(5, 1, [&](int x, int, int) { return values[x]; }), false);
    EXPECT_EQ(chain[1].rgba[0], 20);   // 50 / 2.5
    EXPECT_EQ(chain[1].rgba[4], 148);  // 370 / 2.5
    EXPECT_EQ(chain[2].rgba[0], 84);   // 420 / 5, from the unrounded level
}

// Every texel weighs the same in every level: the mean stays, within the half step of each rounded texel.
TEST(Mipmap, OddSizesConserveTheMean) {
    for (const auto& [width, height] : {std::pair{3, 1}, {5, 3}, {7, 7}, {1, 5}, {641, 359}}) {
        const TextureImage source = noise(width, height);
        for (const TextureImage& level : makeMipmaps(source, false))
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_NEAR(mean(level, c), mean(source, c), 0.5001) << width << "x" << height;
    }
}

// Every code, through decoding, the sums' rounding and encoding, comes back; odd weights included.
TEST(Mipmap, ConstantImagesStayConstant) {
    for (int value = 0; value < 256; ++value)
        for (const bool srgb : {false, true})
            for (const TextureImage& level :
                 makeMipmaps(image(7, 6, [&](int, int, int) { return value; }), srgb))
                for (const std::uint8_t code : level.rgba) ASSERT_EQ(code, value) << srgb;
}

// Encoding is exact rounding: a pair of codes averages to the code nearest to the mean computed in double.
TEST(Mipmap, EncodingRoundsToTheNearestCode) {
    const auto decode = [](double s) {
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    const auto encode = [](double l) {
        return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    };
    for (int a = 0; a < 256; a += 3)
        for (int b = 0; b < 256; ++b) {
            const auto chain = makeMipmaps(image(2, 1, [&](int x, int, int) { return x ? b : a; }), true);
            const double exact = 255 * encode((decode(a / 255.0) + decode(b / 255.0)) / 2);
            // 0.5 and what float weights and the two branches' meeting point (they miss by 1e-7) can move.
            ASSERT_NEAR(chain[1].rgba[0], exact, 0.5 + 1e-3) << a << " " << b;
        }
}

TEST(Mipmap, AnyNumberOfThreadsGivesTheSameBits) {
    const TextureImage source = noise(517, 301);
    const auto many = makeMipmaps(source, true);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = makeMipmaps(source, true);
    ASSERT_EQ(many.size(), single.size());
    for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(many[i].rgba, single[i].rgba) << i;
}
