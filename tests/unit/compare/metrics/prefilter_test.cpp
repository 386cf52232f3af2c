// SPDX-License-Identifier: MIT
// Images before they are compared: blurred, or shifted pixel by pixel, compared with sums over all pixels.
#include "compare/metrics/prefilter.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace diptych {
namespace {

// Of every finite pixel within three deviations along each axis.
double blurredAt(const Image& image, double deviation, int x, int y, int c) {
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    double sum = 0, weights = 0;
    for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u) {
            bool finite = true;
            for (int k = 0; k < image.components; ++k) finite = finite && std::isfinite(image.at(u, v, k));
            if (!finite) continue;
            const double w = std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * deviation * deviation));
            sum += w * double{image.at(u, v, c)};
            weights += w;
        }
    return sum / weights;
}

TEST(Prefilter, ABlurIsTheMeanUnderAGaussian) {
    Image image = noise(13, 9, 1);
    image.at(3, 4, 1) = nan;
    image.at(12, 8, 0) = inf;
    for (const double deviation : {0.3, 1.0, 1.7, 2.1}) {
        const Image result = metrics::blurred(image, deviation);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 13; ++x)
                for (int c = 0; c < 3; ++c) {
                    if ((x == 3 && y == 4) || (x == 12 && y == 8)) {
                        const float kept = image.at(x, y, c), is = result.at(x, y, c);
                        EXPECT_TRUE(kept == is || (std::isnan(kept) && std::isnan(is))) << "holes stay";
                    } else {
                        EXPECT_NEAR(result.at(x, y, c), blurredAt(image, deviation, x, y, c), 2e-6)
                            << deviation << " at " << x << "," << y;
                    }
                }
    }
    for (const double none : {0.0, -1.0, double{nan}})
        EXPECT_EQ(metrics::blurred(rowOf(1, {1, 2, 3}), none).data, (PixelData{1, 2, 3}));
}

// Nine values of one component, of which the middle looks for its nearest.
Image nine(const PixelData& values) {
    Image image(3, 3, 1);
    image.data = values;
    return image;
}

TEST(Prefilter, AShiftTakesTheMostAlikePixelWithinReach) {
    const Image row = rowOf(1, {5, 1, 2, 9, 4});
    const auto shiftedTo = [&](const PixelData& reference, int radius) {
        return metrics::shifted(rowOf(1, reference), row, radius).data;
    };
    for (const int none : {0, -1}) EXPECT_EQ(shiftedTo({9, 9, 9, 9, 9}, none), row.data);
    EXPECT_EQ(shiftedTo({9, 9, 9, 9, 9}, 1), (PixelData{5, 5, 9, 9, 9}));
    EXPECT_EQ(shiftedTo({9, 9, 9, 9, 9}, 2), (PixelData{5, 9, 9, 9, 9}));
    EXPECT_EQ(shiftedTo({3, 3, 3, 3, 3}, 1), (PixelData{5, 2, 2, 2, 4})) << "of equals, the pixel itself";
    // Of equal differences, the nearer pixel; of equal distances, the upper, then the left one.
    EXPECT_EQ(metrics::shifted(nine(PixelData(9, 4)), nine({3, 3, 3, 3, 9, 5, 3, 3, 3}), 1).data[4], 3);
    EXPECT_EQ(metrics::shifted(nine(PixelData(9, 4)), nine({3, 5, 3, 3, 9, 3, 3, 3, 3}), 1).data[4], 5);
    EXPECT_EQ(metrics::shifted(nine(PixelData(9, 4)), nine({3, 9, 9, 9, 9, 9, 9, 9, 4}), 1).data[4], 4);
    const Image column = metrics::shifted(
        Image(1, 4, 1, 8),
        [] {
            Image image(1, 4, 1);
            image.data = {8, 1, 2, 3};
            return image;
        }(),
        1);
    EXPECT_EQ(column.data, (PixelData{8, 8, 3, 3}));
}

// By the largest difference of a component; NaN is like NaN.
TEST(Prefilter, AShiftComparesWholePixels) {
    const Image reference = rowOf(2, {0, 0, 0, 0}), test = rowOf(2, {3, 0, 2, 2});
    EXPECT_EQ(metrics::shifted(reference, test, 1).data, (PixelData{2, 2, 2, 2}));
    const Image broken = metrics::shifted(rowOf(1, {nan, 1}), rowOf(1, {1, nan}), 1);
    EXPECT_TRUE(std::isnan(broken.data[0]));
    EXPECT_EQ(broken.data[1], 1);
}

}  // namespace
}  // namespace diptych
