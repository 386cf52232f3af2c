// SPDX-License-Identifier: MIT
// Structural similarity, compared with its formula and with closed forms.
#include "compare/metrics/ssim.h"

#include "compare/metrics/standard.h"
#include "tests/support/errors.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace diptych {

using namespace metrics;

namespace {

constexpr double c1 = 1e-4, c2 = 9e-4;  // (0.01 L)^2, (0.03 L)^2

Image plane(int width, int height, unsigned seed) {
    Image image = noise(width, height, seed);
    Image first(width, height, 1);
    for (std::size_t i = 0; i < first.pixels(); ++i) first.data[i] = image.pixel(i)[0];
    return first;
}

std::vector<std::uint8_t> everywhere(const Image& image) {
    return std::vector<std::uint8_t>(image.pixels(), 1);
}

std::optional<double> ssim(const Image& a, const Image& b, const std::vector<std::uint8_t>& covered) {
    const auto rows = [](const Image& plane) {
        return
            [&plane](float* out, int y) { std::copy_n(&plane.data[plane.offset(0, y)], plane.width, out); };
    };
    return metrics::ssim(a.width, a.height, rows(a), rows(b), covered);
}

// One window around (x, y), as in the paper: weighted means, then weighted squares of the deviations.
double window(const Image& a, const Image& b, int x, int y) {
    double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, covariance = 0;
    const auto each = [&](auto use) {
        for (int j = -5; j <= 5; ++j)
            for (int i = -5; i <= 5; ++i)
                use(std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5)), double{a.at(x + i, y + j)},
                    double{b.at(x + i, y + j)});
    };
    each([&](double w, double p, double q) {
        weights += w;
        ma += w * p;
        mb += w * q;
    });
    ma /= weights;
    mb /= weights;
    each([&](double w, double p, double q) {
        va += w * (p - ma) * (p - ma) / weights;
        vb += w * (q - mb) * (q - mb) / weights;
        covariance += w * (p - ma) * (q - mb) / weights;
    });
    return (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

// Variances of about 0.08, as differences of floats below 2, have a relative error of about 1e-6.
constexpr double floats = 1e-5;

TEST(Ssim, IsTheMeanOfItsWindows) {
    const Image a = plane(40, 37, 1);
    Image b = plane(40, 37, 2);
    for (std::size_t i = 0; i < b.data.size(); ++i) b.data[i] = 0.5f * (a.data[i] + b.data[i]);
    double sum = 0;
    for (int y = 5; y < 32; ++y)
        for (int x = 5; x < 35; ++x) sum += window(a, b, x, y);
    EXPECT_NEAR(ssim(a, b, everywhere(a)).value(), sum / (27 * 30), floats);
}

TEST(Ssim, CountsWindowsWhoseMiddleIsCovered) {
    const Image a = plane(40, 37, 3), b = plane(40, 37, 4);
    std::vector<std::uint8_t> covered(a.pixels());
    covered[40 * 20 + 17] = covered[40 * 9 + 30] = 1;
    covered[2] = 1;  // no complete window around it
    EXPECT_NEAR(ssim(a, b, covered).value(), (window(a, b, 17, 20) + window(a, b, 30, 9)) / 2, floats);
    std::fill(covered.begin() + 3, covered.end(), std::uint8_t{0});
    EXPECT_FALSE(ssim(a, b, covered).has_value());
}

TEST(Ssim, FlatImagesDifferByTheirMeansAlone) {
    const Image a(20, 20, 1, 0.5f), b(20, 20, 1, 0.25f);
    EXPECT_NEAR(ssim(a, b, everywhere(a)).value(), (2 * 0.125 + c1) / (0.25 + 0.0625 + c1), floats);
}

TEST(Ssim, ANegativeIsBelowZero) {
    const Image a = plane(40, 40, 5);
    Image b = a;
    for (float& v : b.data) v = 1 - v;
    EXPECT_LT(ssim(a, b, everywhere(a)).value(), -0.5);
}

TEST(Ssim, WindowsWithANanAreLeftOut) {
    const Image a = plane(40, 37, 6);
    Image b = plane(40, 37, 7);
    b.at(20, 18) = nan;
    double sum = 0;
    int count = 0;
    for (int y = 5; y < 32; ++y)
        for (int x = 5; x < 35; ++x) {
            if (std::abs(x - 20) <= 5 && std::abs(y - 18) <= 5) continue;
            sum += window(a, b, x, y);
            ++count;
        }
    EXPECT_NEAR(ssim(a, b, everywhere(a)).value(), sum / count, floats);
}

TEST(Ssim, SmallImagesHaveNoWindow) {
    EXPECT_FALSE(ssim(Image(10, 40, 1), Image(10, 40, 1), std::vector<std::uint8_t>(400, 1)).has_value());
    EXPECT_FALSE(ssim(Image(40, 10, 1), Image(40, 10, 1), std::vector<std::uint8_t>(400, 1)).has_value());
    EXPECT_TRUE(ssim(Image(11, 11, 1), Image(11, 11, 1), std::vector<std::uint8_t>(121, 1)).has_value());
    EXPECT_THROW(ssim(Image(12, 11, 1), Image(12, 11, 1), std::vector<std::uint8_t>(121, 1)),
                 std::runtime_error);
}

double ofColors(const Image& a, const Image& b, Range range) {
    return standardMetrics(a, b, ChannelKind::color, range, everyPixel(a.pixels())).ssim.value();
}

TEST(Ssim, OfDisplayColoursIsOfTheirLuma) {
    // Red of 0.5 and grey of 0.2126 x 0.5 have the same luma.
    const Image red = flat(20, 20, 0.5f, 0, 0), grey = flat(20, 20, 0.1063f, 0.1063f, 0.1063f);
    EXPECT_NEAR(ofColors(red, grey, Range::display), 1, floats);
    EXPECT_LT(ofColors(red, flat(20, 20, 0.5f, 0.5f, 0.5f), Range::display), 0.9);
}

TEST(Ssim, OfLinearColoursDoesNotDependOnTheirUnit) {
    const Image a = noise(40, 40, 8), b = noise(40, 40, 9);
    Image a1000 = a, b1000 = b;
    for (float& v : a1000.data) v *= 1024;
    for (float& v : b1000.data) v *= 1024;
    EXPECT_NEAR(ofColors(a, b, Range::linear), ofColors(a1000, b1000, Range::linear), 1e-6);
    // Flat: the reference's display value is sRGB of 0.18 / 1.18, a test twice as bright has 0.36 / 1.36.
    const auto srgb = [](double v) { return 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
    const double p = srgb(0.18 / 1.18), q = srgb(0.36 / 1.36);
    EXPECT_NEAR(ofColors(flat(20, 20, 3, 3, 3), flat(20, 20, 6, 6, 6), Range::linear),
                (2 * p * q + c1) / (p * p + q * q + c1), floats);
    EXPECT_LT(ofColors(flat(20, 20, 0, 0, 0), flat(20, 20, 6, 6, 6), Range::linear), 0.1)
        << "a black reference";
}

// Tasks of 64 rows of windows, bands of 16: none is left out or counted twice.
TEST(Ssim, TallImagesHaveAllTheirWindows) {
    for (const int height : {26, 27, 74, 75, 139}) {
        const Image a = plane(13, height, 11), b = plane(13, height, 12);
        double sum = 0;
        for (int y = 5; y < height - 5; ++y)
            for (int x = 5; x < 8; ++x) sum += window(a, b, x, y);
        EXPECT_NEAR(ssim(a, b, everywhere(a)).value(), sum / (3 * (height - 10)), floats) << height;
        // A window in the last row of centres.
        std::vector<std::uint8_t> last(a.pixels());
        last[static_cast<std::size_t>(13 * (height - 6) + 7)] = 1;
        EXPECT_NEAR(ssim(a, b, last).value(), window(a, b, 7, height - 6), floats) << height;
    }
    EXPECT_EQ(faultOf([] { ssim(Image(12, 11, 1), Image(12, 11, 1), std::vector<std::uint8_t>(121, 1)); }),
              "SSIM of 12x11 pixels: 121 coverage values; give one per pixel");
}

// Black has no mean to scale by: radiance is shown as it is. A mean of almost nothing scales by 1e30 at most.
TEST(Ssim, ABlackReferenceIsShownAsItIs) {
    const double q = 1.055 * std::pow(6.0 / 7, 1 / 2.4) - 0.055;
    EXPECT_NEAR(ofColors(flat(20, 20, 0, 0, 0), flat(20, 20, 6, 6, 6), Range::linear), c1 / (q * q + c1),
                1e-7);
    EXPECT_NEAR(ofColors(flat(20, 20, 0, 0, 0), flat(20, 20, -6, -6, -6), Range::linear), 1, floats);
    const auto srgb = [](double v) { return 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
    const double p = srgb(0.1 / 1.1), r = srgb(0.2 / 1.2);  // 1e-31 and 2e-31, scaled by 1e30
    EXPECT_NEAR(
        ofColors(flat(20, 20, 1e-31f, 1e-31f, 1e-31f), flat(20, 20, 2e-31f, 2e-31f, 2e-31f), Range::linear),
        (2 * p * r + c1) / (p * p + r * r + c1), floats);
}

// A pixel that is not finite takes its windows away, in either image and range.
TEST(Ssim, InfiniteColoursHaveNoWindow) {
    const Image a = noise(24, 12, 13), b = noise(24, 12, 14);
    for (const Range range : {Range::display, Range::linear})
        for (const bool inTest : {false, true})
            for (const float bad : {inf, -inf, nan}) {
                Image broken = inTest ? b : a;
                broken.at(0, 6, 1) = bad;
                Coverage right = everyPixel(a.pixels());
                for (std::size_t i = 0; i < a.pixels(); ++i) right.covered[i] = i % 24 > 5;
                right.count = 18 * 12;
                const Image &reference = inTest ? a : broken, &test = inTest ? broken : b;
                const double all = ofColors(reference, test, range);
                const double without =
                    standardMetrics(reference, test, ChannelKind::color, range, right).ssim.value();
                EXPECT_NEAR(all, without, range == Range::display ? 1e-12 : 0.02) << bad;
                EXPECT_FALSE(std::isnan(all));
            }
}

}  // namespace
}  // namespace diptych
