// SPDX-License-Identifier: MIT
// Statistics of two images, compared with values computed by hand.
#include "compare/metrics/channel.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/errors.h"
#include "tests/support/nonfinite.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
ChannelStats scalars(ErrorKind errorKind, const PixelData& baseline, const PixelData& test) {
    return channelStats(errorKind, ChannelKind::scalar, rowOf(1, baseline), rowOf(1, test),
                        everyPixel(baseline.size()));
}
double largest(ErrorKind errorKind, PixelData a, PixelData b) {
    return channelStats(errorKind, ChannelKind::vector, rowOf(3, std::move(a)), rowOf(3, std::move(b)),
                        everyPixel(1))
        .max;
}
double angle(PixelData a, PixelData b) {
    return largest(ErrorKind::angular, std::move(a), std::move(b));
}
double lineAngle(PixelData a, PixelData b) {
    return largest(ErrorKind::axial, std::move(a), std::move(b));
}

TEST(Metrics, AbsoluteByHand) {
    // Errors 0, 0.5, 0.25, 0: all exact in binary.
    const ChannelStats s = scalars(ErrorKind::absolute, {1, 2, 3, 4}, {1, 2.5f, 2.75f, 4});
    EXPECT_EQ(s.max, 0.5);
    EXPECT_EQ(s.mean, 0.1875);
    EXPECT_DOUBLE_EQ(s.rmse, std::sqrt((0.25 + 0.0625) / 4));
    EXPECT_EQ(s.worst_x, 1);
    EXPECT_EQ(s.worst_y, 0);
    EXPECT_EQ(s.different, 2u);
    EXPECT_EQ(s.p99, 0.5) << "rank ceil(0.99 x 4) = 4";
}

TEST(Metrics, PercentilesAreTheNearestRank) {
    PixelData baseline(1000, 0.0f), test(1000);
    for (std::size_t i = 0; i < 1000; ++i)
        test[(i * 617) % 1000] = static_cast<float>(i + 1);  // 1 .. 1000, mixed
    const ChannelStats s = scalars(ErrorKind::absolute, baseline, test);
    EXPECT_EQ(s.p99, 990);
    EXPECT_EQ(s.p999, 999);
    EXPECT_EQ(s.max, 1000);
    EXPECT_EQ(s.mean, 500.5);
}

TEST(Metrics, RelativeIsOverTheBaselinesLargestComponent) {
    // Blue changes by 1 beside a green of 4.
    const ChannelStats s = channelStats(ErrorKind::relative, ChannelKind::color, rowOf(3, {0, 4, 1}),
                                        rowOf(3, {0, 4, 2}), everyPixel(1));
    EXPECT_EQ(s.max, 0.25);
}

TEST(Metrics, RelativeHasAFloorOfAThousandthOfTheMeanLuminance) {
    // Rec.709: the first pixel's luminance is 0.7152 x 1000, the second's 0; the mean is 357.6, the floor
    // 0.3576.
    const Image baseline = rowOf(3, {0, 1000, 0, 0, 0, 0}), test = rowOf(3, {0, 1000, 0, 0.5f, 0, 0});
    const ChannelStats s =
        channelStats(ErrorKind::relative, ChannelKind::color, baseline, test, everyPixel(2));
    EXPECT_NEAR(s.max, 0.5 / 0.3576, 1e-12);
    // Scalars: the mean magnitude, (1000 + 0) / 2.
    EXPECT_NEAR(scalars(ErrorKind::relative, {-1000, 0}, {-1000, 0.25f}).max, 0.25 / 0.5, 1e-12);
}

TEST(Metrics, RelativeToABaselineOfZeroIsInfinite) {
    EXPECT_EQ(scalars(ErrorKind::relative, {0, 0}, {0, 1e-9f}).max, infinity);
    EXPECT_EQ(scalars(ErrorKind::relative, {0, 0}, {0, 0}).max, 0)
        << "nothing against nothing is no difference";
}

TEST(Metrics, AnglesAreExactWhereACosineIsNot) {
    EXPECT_DOUBLE_EQ(angle({1, 0, 0}, {0, 1, 0}), 90);
    EXPECT_DOUBLE_EQ(angle({0, 0, 1}, {0, 0, -1}), 180);
    EXPECT_DOUBLE_EQ(angle({2, 0, 0}, {1, 1, 0}), 45) << "lengths do not count";
    // 2^-13 rad: its cosine, 1 - 2^-27, is 1 in float32.
    EXPECT_DOUBLE_EQ(angle({1, 0, 0}, {1, 0x1p-13f, 0}), std::atan(0x1p-13) * 180 / std::numbers::pi);
    EXPECT_EQ(angle({0, 0, 0}, {0, 0, 0}), 0);
    EXPECT_EQ(angle({0, 0, 0}, {0, 0, 1}), 180);
    EXPECT_EQ(angle({0, 0, 1}, {0, 0, 0}), 180);
}

TEST(Metrics, LinesHaveNoSign) {
    EXPECT_EQ(lineAngle({0, 0.6f, 0.8f}, {0, -0.6f, -0.8f}), 0);
    EXPECT_DOUBLE_EQ(lineAngle({1, 0, 0}, {0, 1, 0}), 90);
    EXPECT_DOUBLE_EQ(lineAngle({1, 0, 0}, {1, 1, 0}), 45);
    EXPECT_DOUBLE_EQ(lineAngle({1, 0, 0}, {-1, 1, 0}), 45) << "135 degrees between the vectors";
    // As exact beside -a as beside a.
    EXPECT_DOUBLE_EQ(lineAngle({1, 0, 0}, {-1, 0x1p-13f, 0}), std::atan(0x1p-13) * 180 / std::numbers::pi);
}

TEST(Metrics, AZeroVectorIsPerpendicularToEveryLine) {
    EXPECT_EQ(lineAngle({0, 0, 0}, {0, 0, 0}), 0);
    EXPECT_EQ(lineAngle({0, 0, 0}, {0, 0, 1}), 90);
    EXPECT_EQ(lineAngle({0, 0, 1}, {0, 0, 0}), 90);
}

TEST(Metrics, ExactCountsPixelsNotComponents) {
    const ChannelStats s = channelStats(ErrorKind::exact, ChannelKind::id, rowOf(2, {1, 2, 3, 4, 5, 6}),
                                        rowOf(2, {1, 2, 9, 9, 5, 6.0000005f}), everyPixel(3));
    EXPECT_EQ(s.max, 1);
    EXPECT_EQ(s.different, 2u);
    EXPECT_DOUBLE_EQ(s.mean, 2.0 / 3);
}

TEST(Metrics, NonFiniteAgainstANumberIsInfiniteInEveryMetric) {
    for (const ErrorKind errorKind :
         {ErrorKind::relative, ErrorKind::absolute, ErrorKind::angular, ErrorKind::axial, ErrorKind::exact})
        for (const float bad : {nan, inf, -inf}) {
            const Image good = rowOf(3, {1, 2, 3, 1, 2, 3}), broken = rowOf(3, {1, 2, 3, 1, bad, 3});
            for (const bool inTest : {false, true}) {
                const ChannelStats s = channelStats(errorKind, ChannelKind::vector, inTest ? good : broken,
                                                    inTest ? broken : good, everyPixel(2));
                EXPECT_EQ(s.max, infinity) << nameOf(errorKind);
                EXPECT_EQ(s.mean, infinity);
                EXPECT_EQ(s.infinite, 1u);
                EXPECT_EQ(s.worst_x, 1);
                EXPECT_EQ(s.nonfinite_test, inTest ? 1u : 0u);
                EXPECT_EQ(s.nonfinite_baseline, inTest ? 0u : 1u);
            }
        }
}

TEST(Metrics, TheSameNonFiniteIsNoDifferenceButIsCounted) {
    for (const ErrorKind errorKind :
         {ErrorKind::relative, ErrorKind::absolute, ErrorKind::angular, ErrorKind::axial, ErrorKind::exact}) {
        const Image both = rowOf(3, {1, nan, 3, inf, 2, 3, 1, 2, 3});
        const ChannelStats s = channelStats(errorKind, ChannelKind::color, both, both, everyPixel(3));
        EXPECT_EQ(s.max, 0) << nameOf(errorKind);
        EXPECT_EQ(s.different, 0u);
        EXPECT_EQ(s.nonfinite_baseline, 2u);
        EXPECT_EQ(s.nonfinite_test, 2u);
    }
    EXPECT_EQ(scalars(ErrorKind::absolute, {inf}, {-inf}).max, infinity)
        << "opposite infinities are not the same";
}

TEST(Metrics, ANonFiniteBaselinePixelDoesNotLiftTheRelativeFloor) {
    // If the mean included infinity, every difference would be divided by infinity and pass.
    EXPECT_EQ(scalars(ErrorKind::relative, {inf, 1}, {inf, 1.5f}).max, 0.5);
}

TEST(Metrics, ATrueDifferenceBelowFloat32StaysVisible) {
    EXPECT_EQ(scalars(ErrorKind::absolute, {1}, {std::nextafter(1.0f, 2.0f)}).max, 0x1p-23);
}

TEST(Metrics, SizesMustAgree) {
    EXPECT_THROW(channelStats(ErrorKind::absolute, ChannelKind::scalar, rowOf(1, {1}), rowOf(1, {1, 2}),
                              everyPixel(1)),
                 std::runtime_error);
    EXPECT_THROW(channelStats(ErrorKind::angular, ChannelKind::vector, rowOf(2, {1, 1}), rowOf(2, {1, 2}),
                              everyPixel(1)),
                 std::runtime_error);
}

TEST(Metrics, UnequalPixelsSeesBitsOrUlps) {
    const float up = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(unequalPixels(rowOf(1, {1, 0, nan}), rowOf(1, {1, -0.0f, nan}), 0), 1u) << "-0 is not 0";
    EXPECT_EQ(unequalPixels(rowOf(1, {1}), rowOf(1, {up}), 0), 1u);
    EXPECT_EQ(unequalPixels(rowOf(1, {1}), rowOf(1, {up}), 16), 0u);
    // 17 steps of 2^-23, relative to the largest component 1, whatever the small component's own step.
    EXPECT_EQ(unequalPixels(rowOf(2, {1, 0}), rowOf(2, {1, 17 * 0x1p-23f}), 16), 1u);
    EXPECT_EQ(unequalPixels(rowOf(2, {1, 0}), rowOf(2, {1, 15 * 0x1p-23f}), 16), 0u);
    EXPECT_EQ(unequalPixels(rowOf(1, {1}), rowOf(1, {nan}), 16), 1u);
}

// Rec.709 for colours of three components; else the length. Of a covered pixel each, in any row.
TEST(Metrics, TheFloorIsOfCoveredPixelsMagnitudes) {
    const auto floorOf = [](ChannelKind kind, const Image& baseline, const Coverage& covered) {
        return PixelError(ErrorKind::relative, kind, baseline, covered).floor();
    };
    const double weights[] = {0.2126, 0.7152, 0.0722};
    for (int c = 0; c < 3; ++c) {
        Image one(1, 1, 3);
        one.at(0, 0, c) = -2;
        EXPECT_NEAR(floorOf(ChannelKind::color, one, everyPixel(1)), 2e-3 * weights[c], 1e-12);
        EXPECT_DOUBLE_EQ(floorOf(ChannelKind::vector, one, everyPixel(1)), 2e-3);
    }
    EXPECT_DOUBLE_EQ(floorOf(ChannelKind::color, rowOf(4, {1, 1, 1, 1}), everyPixel(1)), 2e-3);
    EXPECT_DOUBLE_EQ(floorOf(ChannelKind::color, rowOf(2, {3, 4}), everyPixel(1)), 5e-3);
    Image grid(2, 3, 1);
    grid.data = {1, 2, 4, 8, inf, 32};
    Coverage some{{0, 1, 1, 0, 1, 1}, 4, true};
    EXPECT_DOUBLE_EQ(floorOf(ChannelKind::scalar, grid, some), (2.0 + 4 + 32) / 3 * 1e-3);
    some.covered.assign(6, 0);
    EXPECT_EQ(floorOf(ChannelKind::scalar, grid, some), 0);
    EXPECT_EQ(PixelError(ErrorKind::absolute, ChannelKind::scalar, grid, everyPixel(6)).floor(), 0);
}

TEST(Metrics, WhatCannotBeComparedIsNamed) {
    const auto why = [](ErrorKind errorKind, const Image& a, const Image& b, std::size_t covered) {
        return faultOf([&] { channelStats(errorKind, ChannelKind::scalar, a, b, everyPixel(covered)); });
    };
    const Image image(3, 2, 1);
    EXPECT_EQ(why(ErrorKind::absolute, image, Image(2, 2, 1), 6),
              "images of 3x2x1 and 2x2x1 cannot be compared");
    EXPECT_EQ(why(ErrorKind::absolute, image, Image(3, 1, 1), 6),
              "images of 3x2x1 and 3x1x1 cannot be compared");
    EXPECT_EQ(why(ErrorKind::absolute, image, Image(3, 2, 2), 6),
              "images of 3x2x1 and 3x2x2 cannot be compared");
    EXPECT_EQ(why(ErrorKind::absolute, image, image, 5), "images of 3x2x1 and 3x2x1 cannot be compared");
    EXPECT_EQ(why(ErrorKind::absolute, image, image, 6), "");
    for (const ErrorKind errorKind : {ErrorKind::angular, ErrorKind::axial}) {
        EXPECT_EQ(why(errorKind, Image(3, 2, 2), Image(3, 2, 2), 6),
                  "angles need vectors of 3 components, not 2");
        EXPECT_EQ(why(errorKind, Image(3, 2, 3), Image(3, 2, 3), 6), "");
    }
    EXPECT_NE(faultOf([&] { errorImage(ErrorKind::exact, ChannelKind::id, image, image, everyPixel(5)); }),
              "");
    EXPECT_NE(faultOf([&] { unequalPixels(image, Image(3, 1, 1), 0); }), "");
}

TEST(Metrics, TheWorstIsTheFirstInRowOrder) {
    Image baseline(3, 2, 1), test(3, 2, 1);
    test.data = {1, 0, 2, 3, 3, 0};
    const ChannelStats s =
        channelStats(ErrorKind::absolute, ChannelKind::scalar, baseline, test, everyPixel(6));
    EXPECT_EQ(s.worst_x, 0);
    EXPECT_EQ(s.worst_y, 1);
    EXPECT_EQ(s.different, 4u);
    EXPECT_EQ(s.infinite, 0u);
    EXPECT_DOUBLE_EQ(s.mean, 9.0 / 6);
    EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(23.0 / 6));
    const auto names = s.byName();
    const std::pair<const char*, double> expected[] = {
        {"max", s.max}, {"mean", s.mean}, {"rmse", s.rmse}, {"p99", s.p99}, {"p999", s.p999}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_STREQ(names[i].first, expected[i].first);
        EXPECT_EQ(names[i].second, expected[i].second);
    }
    EXPECT_EQ(channelStats(ErrorKind::absolute, ChannelKind::scalar, test, test, everyPixel(6)).worst_x, -1);
    EXPECT_EQ(ChannelStats().worst_y, -1);
}

// Ranks count what is equal: of 1000, the 990th is the last zero, the 999th the ninth of ten others.
TEST(Metrics, RanksBeginAtTheZeros) {
    PixelData baseline(1000, 0.0f), test(1000, 0.0f);
    for (std::size_t i = 0; i < 10; ++i) test[100 * i] = static_cast<float>(10 - i);
    ChannelStats s = scalars(ErrorKind::absolute, baseline, test);
    EXPECT_EQ(s.p99, 0);
    EXPECT_EQ(s.p999, 9);
    test[1] = 0.5f;
    s = scalars(ErrorKind::absolute, baseline, test);
    EXPECT_EQ(s.p99, 0.5);
    EXPECT_EQ(s.p999, 9);
}

// More errors with the same leading bits than are gathered at once: steps between 1 and 1 + 1/16, each twice.
TEST(Metrics, RanksAreExactAmongAMillion) {
    const Image baseline(1024, 1025, 1);
    Image test = baseline;
    const std::size_t n = test.pixels(), steps = 1 << 19, more = n / 2 - steps;
    for (std::size_t i = 0; i < n; ++i)
        test.data[i * 617 % n] = 1 + 0x1p-23f * static_cast<float>(i / 2 % steps);
    const ChannelStats s =
        channelStats(ErrorKind::absolute, ChannelKind::scalar, baseline, test, everyPixel(n));
    // The lowest `more` steps stand there four times.
    const auto rank = [&](double fraction) {
        const double below = std::ceil(fraction * static_cast<double>(n)) - 1 - 4 * static_cast<double>(more);
        return 1 + 0x1p-23 * (static_cast<double>(more) + std::floor(below / 2));
    };
    EXPECT_EQ(s.p99, rank(0.99));
    EXPECT_EQ(s.p999, rank(0.999));
}

// Equal NaNs are no difference, but there is no angle beside them.
TEST(Metrics, AnAngleNeedsNumbers) {
    for (const ErrorKind errorKind : {ErrorKind::angular, ErrorKind::axial}) {
        EXPECT_EQ(largest(errorKind, {nan, 1, 0}, {nan, 0.5f, 0}), infinity);
        EXPECT_EQ(largest(errorKind, {nan, 1, 0}, {nan, 1, 0}), 0);
    }
    EXPECT_EQ(largest(ErrorKind::absolute, {nan, 1, 0}, {nan, 0.5f, 0}), 0.5);
    EXPECT_EQ(largest(ErrorKind::exact, {nan, 1, 0}, {nan, 0.5f, 0}), 1);
    EXPECT_EQ(largest(ErrorKind::relative, {inf, 2, 0}, {inf, 1, 0}), 0.5) << "of the largest finite one";
}

TEST(Metrics, AnErrorBeyondFloatsIsInfiniteInItsImage) {
    constexpr float most = std::numeric_limits<float>::max();
    const Image errors = errorImage(ErrorKind::absolute, ChannelKind::scalar, rowOf(1, {0, most, 1, nan}),
                                    rowOf(1, {most, -most, 1.5f, 0}), everyPixel(4));
    EXPECT_EQ(errors.data, (PixelData{most, inf, 0.5f, inf}));
}

TEST(Metrics, UnequalPixelsCountOnceFromTheSeventeenthStepOn) {
    constexpr float step = 0x1p-23f;
    EXPECT_EQ(unequalPixels(rowOf(2, {1, 0}), rowOf(2, {1, 16 * step}), 16), 0u) << "just as many";
    EXPECT_EQ(unequalPixels(rowOf(2, {1, 0}), rowOf(2, {1, 16.5f * step}), 16), 1u);
    EXPECT_EQ(unequalPixels(rowOf(2, {0, 1}), rowOf(2, {2, 1}), 0), 1u);
    EXPECT_EQ(unequalPixels(rowOf(2, {0, 1, 4, 4}), rowOf(2, {2, 3, 4, 5}), 0), 2u)
        << "pixels, not components";
    EXPECT_EQ(unequalPixels(rowOf(1, {nan}), rowOf(1, {1}), 0), 1u);
    EXPECT_EQ(unequalPixels(rowOf(1, {nan}), rowOf(1, {-nan}), 0), 0u);
    EXPECT_EQ(unequalPixels(rowOf(1, {2}), rowOf(1, {2 + 3 * step}), 1), 1u);
    EXPECT_EQ(unequalPixels(rowOf(1, {2}), rowOf(1, {2 + 2 * step}), 1), 0u) << "of the larger one";
    EXPECT_EQ(gpuUlps, 16);
    const Image one = onePixel(rowOf(2, {1, 2, 3, 4}), 1);
    EXPECT_EQ(one.width * one.height, 1);
    EXPECT_EQ(one.data, (PixelData{3, 4}));
}

}  // namespace
}  // namespace diptych
