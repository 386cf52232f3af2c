// SPDX-License-Identifier: MIT
// Metrics of two images, compared with values computed by hand.
#include "compare/metrics/standard.h"
#include "tests/support/errors.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

StandardMetrics scalars(PixelData reference, PixelData test) {
    const std::size_t count = reference.size();
    return standardMetrics(rowOf(1, std::move(reference)), rowOf(1, std::move(test)), ChannelKind::scalar,
                           Range::linear, everyPixel(count));
}
StandardMetrics colors(const Image& reference, const Image& test, Range range = Range::linear) {
    return standardMetrics(reference, test, ChannelKind::color, range, everyPixel(reference.pixels()));
}
StandardMetrics vectors(PixelData reference, PixelData test) {
    const std::size_t count = reference.size() / 3;
    return standardMetrics(rowOf(3, std::move(reference)), rowOf(3, std::move(test)), ChannelKind::vector,
                           Range::linear, everyPixel(count));
}

TEST(StandardMetrics, ByHand) {
    // Differences 0, 0.5, 0.25, 0; all exact in binary except the relative ones.
    const StandardMetrics m = scalars({1, 2, 3, 4}, {1, 2.5f, 2.75f, 4});
    EXPECT_EQ(m.mse, 0.078125);
    EXPECT_EQ(m.rmse, std::sqrt(0.078125));
    EXPECT_EQ(m.mae, 0.1875);
    EXPECT_DOUBLE_EQ(m.relative_mse, (0.25 / 4.01 + 0.0625 / 9.01) / 4);
    EXPECT_EQ(m.peak, 4);
    EXPECT_DOUBLE_EQ(m.psnr, 10 * std::log10(16 / 0.078125));
    EXPECT_EQ(m.relative_max, 0.25);
    EXPECT_NEAR(m.relative_mean, (0.25 + 0.25 / 3) / 4, 1e-8) << "of floats";
    EXPECT_EQ(m.pixels, 4u);
    EXPECT_EQ(m.different, 2u);
    EXPECT_FALSE(m.ssim.has_value()) << "no colours";
}

TEST(StandardMetrics, PercentilesAreTheNearestRank) {
    PixelData reference(1000, 1.0f), test(1000);
    for (std::size_t i = 0; i < 1000; ++i) test[(i * 617) % 1000] = static_cast<float>(i + 2);
    const StandardMetrics m = scalars(reference, test);
    EXPECT_EQ(m.relative_p99, 990);
    EXPECT_EQ(m.relative_p999, 999);
    EXPECT_EQ(m.relative_max, 1000);
    EXPECT_EQ(scalars({0, 0}, {0, 1}).relative_max, endless) << "of nothing";
}

TEST(StandardMetrics, TheImageItselfHasNoError) {
    const Image image = noise(50, 40, 1, 0, 100);
    for (const Range range : {Range::display, Range::linear}) {
        const StandardMetrics m = colors(image, image, range);
        EXPECT_EQ(m.mse + m.mae + m.relative_mse + m.relative_max + m.ulp_max + m.ulp_mean, 0);
        EXPECT_EQ(m.psnr, endless);
        EXPECT_EQ(m.ssim, 1.0);
        EXPECT_EQ(m.different, 0u);
    }
}

TEST(StandardMetrics, DisplayValuesHaveAPeakOfOne) {
    const StandardMetrics m =
        colors(flat(20, 20, 0.5f, 0.5f, 0.5f), flat(20, 20, 0.25f, 0.25f, 0.25f), Range::display);
    EXPECT_EQ(m.peak, 1);
    EXPECT_DOUBLE_EQ(m.psnr, 10 * std::log10(16.0));
}

TEST(StandardMetrics, UlpsAreStepsBetweenFloats) {
    const float one = std::nextafter(1.0f, 2.0f), min = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(scalars({1}, {one}).ulp_max, 1);
    EXPECT_EQ(scalars({1}, {2}).ulp_max, 1 << 23);
    EXPECT_EQ(scalars({0}, {-0.0f}).ulp_max, 0);
    EXPECT_EQ(scalars({min}, {-min}).ulp_max, 2) << "over 0";
    EXPECT_EQ(scalars({1, 1, 1, 1}, {one, 1, 1, 2}).ulp_mean, (1 + (1 << 23)) / 4.0);
    constexpr float max = std::numeric_limits<float>::max();
    EXPECT_EQ(scalars({-max}, {max}).ulp_max, 2.0 * 0x7f7fffff) << "exact, past what 32 bits hold";
}

TEST(StandardMetrics, ANanAgainstANumberIsInfinite) {
    const StandardMetrics m = scalars({1, nan, 3, inf, nan, inf}, {1, nan, nan, inf, 1, -inf});
    EXPECT_EQ(m.nonfinite_reference, 4u);
    EXPECT_EQ(m.nonfinite_test, 4u);
    EXPECT_EQ(m.nonfinite_different, 3u);
    EXPECT_EQ(m.different, 3u);
    for (const double v : {m.mse, m.rmse, m.mae, m.relative_mse, m.relative_max, m.ulp_max, m.ulp_mean})
        EXPECT_EQ(v, endless);
    EXPECT_EQ(m.psnr, -endless);

    const StandardMetrics alike = scalars({nan, inf, 2}, {nan, inf, 1});
    EXPECT_EQ(alike.relative_max, 0.5);
    EXPECT_EQ(alike.mse, 1.0 / 3);
    EXPECT_EQ(alike.nonfinite_different, 0u);
    // The other, finite components of a pixel with equal NaNs are compared.
    EXPECT_EQ(colors(rowOf(3, {nan, 1, 2}), rowOf(3, {nan, 1, 2.5f})).relative_max, 0.25);
}

TEST(StandardMetrics, WhatIsNotCoveredIsNotThere) {
    Image reference = noise(40, 30, 2), test = noise(40, 30, 3);
    Coverage coverage = everyPixel(reference.pixels());
    Image kept(20, 30, 3), keptTest = kept;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            if (x % 2) {
                coverage.covered[static_cast<std::size_t>(40 * y + x)] = 0;
                --coverage.count;
                set(test, x, y, x == 1 ? nan : 1000.0f);
            } else {
                for (int c = 0; c < 3; ++c) {
                    kept.at(x / 2, y, c) = reference.at(x, y, c);
                    keptTest.at(x / 2, y, c) = test.at(x, y, c);
                }
            }
        }
    const StandardMetrics some =
        standardMetrics(reference, test, ChannelKind::color, Range::linear, coverage);
    const StandardMetrics all = colors(kept, keptTest);
    EXPECT_NEAR(some.mse, all.mse, 1e-15) << "doubles in another order";
    EXPECT_NEAR(some.relative_mean, all.relative_mean, 1e-13);
    EXPECT_EQ(some.relative_max, all.relative_max);
    EXPECT_EQ(some.relative_p99, all.relative_p99);
    EXPECT_EQ(some.relative_p999, all.relative_p999);
    EXPECT_EQ(some.ulp_max, all.ulp_max);
    EXPECT_EQ(some.different, all.different);
    EXPECT_EQ(some.pixels, 600u);
    EXPECT_EQ(some.nonfinite_test, 30u);
    EXPECT_EQ(some.nonfinite_different, 0u);

    coverage.covered.assign(coverage.covered.size(), 0);
    coverage.count = 0;
    const StandardMetrics none =
        standardMetrics(reference, test, ChannelKind::color, Range::linear, coverage);
    EXPECT_EQ(none.relative_max + none.mse + none.psnr, 0);
    EXPECT_FALSE(none.ssim.has_value());
}

TEST(StandardMetrics, AnglesByHand) {
    EXPECT_DOUBLE_EQ(vectors({1, 0, 0}, {0, 2, 0}).angle_max, 90);
    EXPECT_DOUBLE_EQ(vectors({0, 0, 1}, {0, 0, -1}).angle_max, 180);
    EXPECT_EQ(vectors({0, 0, 1}, {0, 0, 3}).angle_max, 0) << "another length";
    EXPECT_EQ(vectors({0, 0, 0}, {0, 0, 1}).angle_max, 180);
    EXPECT_EQ(vectors({1, 0, 0, 0, 1, 0}, {0, 1, 0, 0, 1, 0}).angle_mean, 45);
    // A float32 acos would resolve only 0.02 degrees.
    EXPECT_NEAR(vectors({0, 0, 1}, {0, 1e-6f, 1}).angle_max, 1e-6 * 180 / 3.14159265358979, 1e-10);
    EXPECT_EQ(vectors({0, 0, 1}, {0, nan, 1}).angle_max, endless);
    EXPECT_EQ(colors(rowOf(3, {1, 0, 0}), rowOf(3, {0, 1, 0})).angle_max, 0) << "colours have none";
    EXPECT_EQ(standardMetrics(rowOf(3, {0, 0, 1}), rowOf(3, {0, 0, -1}), ChannelKind::vector, Range::linear,
                              everyPixel(1), ErrorKind::axial)
                  .angle_max,
              0)
        << "lines have no sign";
}

TEST(StandardMetrics, AgreeWithTheChannelsStatistics) {
    const Image a = noise(120, 70, 4, 0, 5), b = noise(120, 70, 5, 0, 5);
    const Coverage all = everyPixel(a.pixels());
    const StandardMetrics m = colors(a, b);
    const ChannelStats relative = channelStats(ErrorKind::relative, ChannelKind::color, a, b, all);
    constexpr double half = 0x1p-24;  // a float's rounding
    EXPECT_NEAR(m.relative_max, relative.max, half * relative.max);
    EXPECT_NEAR(m.relative_mean, relative.mean, half * relative.mean);
    EXPECT_NEAR(m.relative_p99, relative.p99, half * relative.p99);
    EXPECT_NEAR(m.relative_p999, relative.p999, half * relative.p999);
    EXPECT_EQ(m.different, relative.different);
}

TEST(StandardMetrics, ThreadsDoNotChangeABit) {
    const Image a = noise(333, 170, 6, 0, 5), b = noise(333, 170, 7, 0, 5);
    const StandardMetrics many = colors(a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const StandardMetrics single = colors(a, b);
    EXPECT_EQ(many.mse, single.mse);
    EXPECT_EQ(many.relative_mse, single.relative_mse);
    EXPECT_EQ(many.relative_mean, single.relative_mean);
    EXPECT_EQ(many.ulp_mean, single.ulp_mean);
    EXPECT_EQ(many.ssim, single.ssim);
}

TEST(StandardMetrics, OnlyAlikeImagesAreCompared) {
    EXPECT_THROW(colors(grey(1), noise(40, 31, 1)), std::runtime_error);
    EXPECT_THROW(standardMetrics(grey(1), grey(1), ChannelKind::color, Range::linear, everyPixel(3)),
                 std::runtime_error);
    const Image five(2, 2, 5);
    EXPECT_THROW(standardMetrics(five, five, ChannelKind::vector, Range::linear, everyPixel(4)),
                 std::runtime_error);
}

// Bands of 16 rows: what is in the last is as good as in the first. The largest is in the middle.
TEST(StandardMetrics, EveryBandOfRowsCounts) {
    Image reference(2, 40, 3), test(2, 40, 3);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 2; ++x) {
            reference.at(x, y, 0) = 1;
            test.at(x, y, 0) = 1;
        }
    const auto at = [&](int y, float px, float py) {
        test.at(1, y, 0) = px;
        test.at(1, y, 1) = py;
    };
    at(0, 1, 1);    // 45 degrees, sqrt(2) long
    at(15, 0, 2);   // 90 degrees
    at(16, -4, 0);  // 180 degrees, 4 long
    at(31, 0, 1);   // 90 degrees
    at(32, 3, 0);   // another length alone
    at(39, 1, 1);
    reference.at(0, 17, 2) = test.at(0, 17, 2) = 7;
    reference.at(0, 0, 2) = nan;
    test.at(0, 39, 2) = inf;
    test.at(0, 33, 2) = inf;
    Coverage coverage = everyPixel(80);
    coverage.covered[0] = coverage.covered[78] = coverage.covered[66] = 0;
    coverage.count = 77;
    const StandardMetrics m = standardMetrics(reference, test, ChannelKind::vector, Range::linear, coverage);
    EXPECT_EQ(m.angle_max, 180);
    EXPECT_DOUBLE_EQ(m.angle_mean, (45.0 + 90 + 180 + 90 + 45) / 77);
    EXPECT_EQ(m.length_max, 3);
    EXPECT_EQ(m.different, 6u);
    EXPECT_EQ(m.pixels, 77u);
    EXPECT_EQ(m.peak, 7) << "the reference's";
    EXPECT_EQ(m.nonfinite_reference, 1u) << "covered or not";
    EXPECT_EQ(m.nonfinite_test, 2u);
    EXPECT_EQ(m.nonfinite_different, 0u);
    EXPECT_DOUBLE_EQ(m.mae, (1.0 + 1 + 2 + 5 + 1 + 1 + 2 + 1) / (77 * 3));
    EXPECT_DOUBLE_EQ(m.mse, (1.0 + 1 + 4 + 25 + 1 + 1 + 4 + 1) / (77 * 3));
    EXPECT_FALSE(m.ssim.has_value());
    // An infinite difference anywhere makes them infinite, and is counted in each band.
    coverage = everyPixel(80);
    const StandardMetrics all =
        standardMetrics(reference, test, ChannelKind::vector, Range::linear, coverage);
    EXPECT_EQ(all.nonfinite_different, 3u);
    EXPECT_EQ(all.different, 9u);
    for (const double v : {all.angle_max, all.angle_mean, all.length_max, all.mse, all.relative_max})
        EXPECT_EQ(v, endless);
}

TEST(StandardMetrics, LengthsAndLinesByHand) {
    EXPECT_EQ(vectors({3, 4, 0}, {0, 0, 2}).length_max, 3);
    EXPECT_EQ(vectors({3, 4, 0, 1, 0, 0}, {0, 0, 2, 0, 0, 9}).length_max, 8);
    EXPECT_EQ(vectors({nan, 0, 1}, {nan, 0, 1}).length_max, 0);
    // Two components or scalars have none; a line's angle is the smaller one.
    EXPECT_EQ(
        standardMetrics(rowOf(2, {1, 0}), rowOf(2, {0, 2}), ChannelKind::vector, Range::linear, everyPixel(1))
            .length_max,
        0);
    const auto lines = [](const PixelData& a, const PixelData& b) {
        return standardMetrics(rowOf(3, a), rowOf(3, b), ChannelKind::vector, Range::linear, everyPixel(2),
                               ErrorKind::axial);
    };
    EXPECT_EQ(lines({1, 0, 0, 1, 0, 0}, {-1, 0, 0, 0, 1, 0}).angle_mean, 45);
    EXPECT_DOUBLE_EQ(lines({1, 0, 0, 1, 0, 0}, {-1, 1, 0, 1, 0, 0}).angle_max, 45);
}

TEST(StandardMetrics, WhatIsRefusedIsNamed) {
    const auto why = [](const Image& a, const Image& b, std::size_t covered) {
        return faultOf(
            [&] { standardMetrics(a, b, ChannelKind::scalar, Range::linear, everyPixel(covered)); });
    };
    const std::string end = " cannot be compared; give two of the same size with 1 to 4 components";
    EXPECT_EQ(why(Image(3, 2, 1), Image(2, 2, 1), 6), "images of 3x2x1 and 2x2x1" + end);
    EXPECT_EQ(why(Image(3, 2, 1), Image(3, 1, 1), 6), "images of 3x2x1 and 3x1x1" + end);
    EXPECT_EQ(why(Image(3, 2, 1), Image(3, 2, 2), 6), "images of 3x2x1 and 3x2x2" + end);
    EXPECT_EQ(why(Image(3, 2, 5), Image(3, 2, 5), 6), "images of 3x2x5 and 3x2x5" + end);
    EXPECT_EQ(why(Image(3, 2, 0), Image(3, 2, 0), 6), "images of 3x2x0 and 3x2x0" + end);
    EXPECT_EQ(why(Image(3, 2, 1), Image(3, 2, 1), 7), "images of 3x2x1 and 3x2x1" + end);
    for (int components = 1; components <= 4; ++components)
        EXPECT_EQ(why(Image(3, 2, components), Image(3, 2, components), 6), "");
}

}  // namespace
}  // namespace diptych
