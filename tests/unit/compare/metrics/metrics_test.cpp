// SPDX-License-Identifier: MIT
// Statistics of two images, compared with values computed by hand.
#include "compare/metrics/channel.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/nonfinite.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

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

Frame ids(PixelData values) {
    Frame frame;
    frame.settings.size = {static_cast<int>(values.size()), 1};
    frame.channels[Channel::material_id] = rowOf(1, std::move(values));
    return frame;
}

TEST(Coverage, APixelIsBackgroundOnlyInBoth) {
    const Coverage c = coverage(ids({-1, -1, 0, 3}), ids({-1, 2, -1, 3}));
    EXPECT_EQ(c.covered, (std::vector<std::uint8_t>{0, 1, 1, 1}));
    EXPECT_EQ(c.count, 3u);
    EXPECT_TRUE(c.known);
}

TEST(Coverage, DepthTellsWhereThereAreNoIds) {
    Frame frame;
    frame.settings.size = {2, 1};
    frame.channels[Channel::depth] = rowOf(1, {0, 5});
    EXPECT_EQ(coverage(frame, frame).covered, (std::vector<std::uint8_t>{0, 1}));
    Frame bare;
    bare.settings.size = {2, 1};
    bare.channels[Channel::lit] = rowOf(3, {0, 0, 0, 1, 1, 1});
    EXPECT_FALSE(coverage(bare, bare).known);
    EXPECT_EQ(coverage(bare, bare).count, 2u);
}

TEST(Coverage, AChannelOfAnotherSizeIsAnError) {
    Frame frame = ids({0, 1});
    frame.channels[Channel::depth] = rowOf(1, {0, 5, 6});
    EXPECT_THROW(coverage(frame, frame), std::runtime_error);
}

TEST(Coverage, BackgroundIsOutsideMeansAndErrors) {
    const Coverage c = coverage(ids({-1, 1}), ids({-1, 1}));
    const Image baseline = rowOf(1, {0, 1}), test = rowOf(1, {7, 1.5f});  // 7: background, must not count
    EXPECT_EQ(channelStats(ErrorKind::absolute, ChannelKind::scalar, baseline, test, c).mean, 0.5);
    const Image errors = errorImage(ErrorKind::absolute, ChannelKind::scalar, baseline, test, c);
    EXPECT_EQ(errors.data, (PixelData{0, 0.5f}));
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

}  // namespace
}  // namespace diptych
