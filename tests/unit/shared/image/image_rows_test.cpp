// SPDX-License-Identifier: MIT
// Metrics computed a few rows at a time, also from 8-bit images: bitwise identical to those of whole float
// images.
#include "shared/image/image_rows.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/flip.h"
#include "compare/metrics/ssim.h"
#include "compare/metrics/standard.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace diptych {
namespace {

// A FLIP tile is at most 256 x 128 pixels, a band of sums 16 rows, an SSIM task 64 rows of windows. Sizes
// at these limits, next to them, and of one row or column.
struct Wide {
    int width, height;
};
constexpr Wide sizes[]{{1, 1},   {97, 1},   {1, 97},  {33, 16},   {33, 17}, {40, 74},
                       {40, 75}, {64, 129}, {257, 9}, {301, 138}, {19, 331}};

// Most pixels of two such images are equal, others differ a little.
Image8 codes(Wide size, int components, unsigned seed) {
    const auto count = static_cast<std::size_t>(size.width * size.height * components);
    Image8 image{size.width, size.height, components, std::vector<std::uint8_t>(count)};
    std::mt19937 random(7), change(seed);
    for (std::uint8_t& v : image.data) {
        v = static_cast<std::uint8_t>(random());
        if (change() % 3 == 0) v = static_cast<std::uint8_t>(v ^ (change() & 15u));
    }
    return image;
}
Image floats(const Image8& image, int shown) {
    const auto width = static_cast<std::size_t>(shown), stored = static_cast<std::size_t>(image.components);
    Image decoded(image.width, image.height, shown);
    for (std::size_t i = 0; i < decoded.pixels(); ++i)
        for (std::size_t c = 0; c < width; ++c)
            decoded.data[width * i + c] =
                static_cast<float>(image.data[stored * i + std::min(c, stored - 1)]) / 255.0f;
    return decoded;
}
std::string name(Wide size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void expectSame(const ChannelStats& a, const ChannelStats& b) {
    EXPECT_EQ(a.max, b.max);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.rmse, b.rmse);
    EXPECT_EQ(a.p99, b.p99);
    EXPECT_EQ(a.p999, b.p999);
    EXPECT_EQ(a.worst_x, b.worst_x);
    EXPECT_EQ(a.worst_y, b.worst_y);
    EXPECT_EQ(a.different, b.different);
}
void expectSame(const StandardMetrics& a, const StandardMetrics& b) {
    EXPECT_EQ(a.mse, b.mse);
    EXPECT_EQ(a.mae, b.mae);
    EXPECT_EQ(a.relative_mse, b.relative_mse);
    EXPECT_EQ(a.relative_mean, b.relative_mean);
    EXPECT_EQ(a.relative_max, b.relative_max);
    EXPECT_EQ(a.relative_p99, b.relative_p99);
    EXPECT_EQ(a.relative_p999, b.relative_p999);
    EXPECT_EQ(a.ulp_mean, b.ulp_mean);
    EXPECT_EQ(a.ssim, b.ssim);
}

TEST(ImageRows, EightBitsAndFloatsHaveTheSameMetrics) {
    for (const Wide size : sizes)
        for (const int components : {1, 3}) {
            SCOPED_TRACE(name(size) + " of " + std::to_string(components));
            const Image8 a = codes(size, components, 1), b = codes(size, components, 2);
            const Image fa = floats(a, 3), fb = floats(b, 3);
            const ImageRows ca(a, 3), cb(b, 3);
            Coverage all = everyPixel(fa.pixels());
            expectSame(channelStats(ErrorKind::absolute, ChannelKind::color, ca, cb, all),
                       channelStats(ErrorKind::absolute, ChannelKind::color, fa, fb, all));
            expectSame(standardMetrics(ca, cb, ChannelKind::color, Range::display, all),
                       standardMetrics(fa, fb, ChannelKind::color, Range::display, all));
            const FlipResult flip = ldrFlip(fa, fb), rows = ldrFlip(ca, cb);
            EXPECT_EQ(rows.error.data, flip.error.data);
            EXPECT_EQ(rows.weighted_median, flip.weighted_median);
            if (components == 3) {
                EXPECT_EQ(ldrFlip(ca, fb).error.data, flip.error.data) << "one of each";
                EXPECT_EQ(hdrFlip(ca, cb).error.data, hdrFlip(fa, fb).error.data);
            }
            EXPECT_EQ(errorImage(ErrorKind::relative, ChannelKind::color, ca, cb, all).data,
                      errorImage(ErrorKind::relative, ChannelKind::color, fa, fb, all).data);
        }
}

// Compared with sorting all errors at once.
TEST(ImageRows, RanksAreThoseOfTheSortedErrors) {
    for (const ErrorKind errorKind :
         {ErrorKind::absolute, ErrorKind::relative, ErrorKind::angular, ErrorKind::axial, ErrorKind::exact})
        for (const Wide size : sizes) {
            SCOPED_TRACE(name(size) + " " + std::to_string(static_cast<int>(errorKind)));
            const Image a = noise(size.width, size.height, 1);
            Image b = a;
            std::mt19937 random(3);
            for (float& v : b.data)
                if (random() % 4 == 0) v += std::exp2(-static_cast<float>(random() % 30));
            if (b.pixels() > 300) b.data[400] = std::numeric_limits<float>::infinity();
            Coverage covered = everyPixel(a.pixels());
            if (b.pixels() > 9) covered.covered[5] = 0;
            covered.count = static_cast<std::size_t>(std::ranges::count(covered.covered, 1));
            const PixelError error(errorKind, ChannelKind::color, a, covered);
            std::vector<double> all;
            for (std::size_t i = 0; i < a.pixels(); ++i)
                if (covered.covered[i]) all.push_back(error(b.pixel(i), a.pixel(i)));
            std::ranges::sort(all);
            const auto at = [&](double fraction) {
                const auto rank = std::ceil(fraction * static_cast<double>(all.size()));
                return all[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
            };
            const ChannelStats stats = channelStats(errorKind, ChannelKind::color, a, b, covered);
            EXPECT_EQ(stats.p99, at(0.99));
            EXPECT_EQ(stats.p999, at(0.999));
            EXPECT_EQ(stats.max, all.back());
        }
}

// More errors share their first 16 bits than are gathered at once; the following bits distinguish them.
TEST(ImageRows, RanksOfManyErrorsThatAreAlmostTheSame) {
    const int width = 1100, height = 1000;
    const Image a(width, height, 1, 0);
    Image b(width, height, 1);
    for (std::size_t i = 0; i < b.pixels(); ++i)
        b.data[i] = 1 + static_cast<float>(i * 7919 % b.pixels()) * 0x1p-23f;
    const ChannelStats stats =
        channelStats(ErrorKind::absolute, ChannelKind::scalar, a, b, everyPixel(a.pixels()));
    EXPECT_EQ(stats.p99, 1 + (0.99 * 1'100'000 - 1) * 0x1p-23);
    EXPECT_EQ(stats.p999, 1 + (0.999 * 1'100'000 - 1) * 0x1p-23);
}

// Windows of one row at a time, each from the eleven rows it reads.
TEST(ImageRows, SsimOfBandsIsThatOfTheirWindows) {
    for (const Wide size : sizes) {
        if (size.width < 11 || size.height < 11) continue;
        SCOPED_TRACE(name(size));
        const Image a = floats(codes(size, 1, 1), 1), b = floats(codes(size, 1, 2), 1);
        const auto from = [](const Image& plane, int top) {
            return [&plane, top](float* out, int y) {
                std::copy_n(&plane.data[plane.offset(0, top + y)], plane.width, out);
            };
        };
        double sum = 0;
        for (int top = 0; top + 11 <= size.height; ++top)
            sum += metrics::ssim(size.width, 11, from(a, top), from(b, top),
                                 std::vector<std::uint8_t>(static_cast<std::size_t>(11 * size.width), 1))
                       .value();
        const double mean = sum / (size.height - 10);
        const std::vector<std::uint8_t> everywhere(a.pixels(), 1);
        EXPECT_NEAR(metrics::ssim(size.width, size.height, from(a, 0), from(b, 0), everywhere).value(), mean,
                    1e-13)
            << "sums of the same numbers";
    }
}

}  // namespace
}  // namespace diptych
