// SPDX-License-Identifier: MIT
// Arithmetic on rows of pixels, value by value.
#include "compare/metrics/convolve.h"
#include "compare/metrics/fast_math.h"
#include "compare/metrics/pixel.h"
#include "compare/metrics/standard_rows.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace diptych {
namespace {

constexpr float most = std::numeric_limits<float>::max();

// Whole numbers, so that sums in any order are exact. Radii with and without a remainder of four.
TEST(MetricRows, SumsOfTapsAreExact) {
    constexpr int n = 5;
    for (int radius = 0; radius <= 9; ++radius) {
        std::vector<std::vector<float>> rows;
        std::vector<float> weights;
        for (int k = -radius; k <= radius; ++k) {
            rows.emplace_back();
            for (int i = 0; i < n; ++i) rows.back().push_back(static_cast<float>((k * 7 + i * 3 + 100) % 23));
        }
        for (int k = 0; k <= radius; ++k) weights.push_back(static_cast<float>(1 + k * k));
        std::vector<const float*> taps;
        for (const std::vector<float>& row : rows) taps.push_back(row.data());
        std::array<float, n + 1> even{}, odd{};
        even.fill(-1);
        odd.fill(-1);
        convolveEven(even.data(), taps.data() + radius, weights.data(), radius, n);
        convolveOdd(odd.data(), taps.data() + radius, weights.data(), radius, n);
        for (std::size_t i = 0; i < n; ++i) {
            float both = weights[0] * taps[static_cast<std::size_t>(radius)][i], difference = 0;
            for (std::size_t k = 1; k < weights.size(); ++k) {
                const auto middle = static_cast<std::size_t>(radius);
                both += weights[k] * (taps[middle + k][i] + taps[middle - k][i]);
                difference += weights[k] * (taps[middle + k][i] - taps[middle - k][i]);
            }
            EXPECT_EQ(even[i], both) << radius;
            EXPECT_EQ(odd[i], difference) << radius;
        }
        EXPECT_EQ(even[n], -1) << "behind the row";
        EXPECT_EQ(odd[n], -1);
    }
}

// Eight lanes: counts below, at and beside their multiples.
TEST(MetricRows, SumsAreOverAllComponents) {
    for (const int n : {1, 7, 8, 9, 16, 19}) {
        std::vector<float> test, reference;
        double absolute = 0, squared = 0, relative = 0;
        for (int i = 0; i < n; ++i) {
            const double r = i % 4, t = r + 1 + i;
            reference.push_back(static_cast<float>(r));
            test.push_back(static_cast<float>(t));
            absolute += t - r;
            squared += (t - r) * (t - r);
            relative += (t - r) * (t - r) / (r * r + 0.01);
        }
        RowSums sums;
        addRow(sums, test.data(), reference.data(), n);
        RowSums twice = sums;
        twice.add(sums);
        EXPECT_EQ(RowSums::total(sums.absolute), absolute) << n;
        EXPECT_EQ(RowSums::total(sums.squared), squared) << n;
        EXPECT_NEAR(RowSums::total(sums.relative), relative, 1e-9 * relative) << n;
        EXPECT_EQ(RowSums::total(twice.absolute), 2 * absolute);
        EXPECT_EQ(RowSums::total(twice.squared), 2 * squared);
        EXPECT_NEAR(RowSums::total(twice.relative), 2 * relative, 1e-9 * relative);
        EXPECT_EQ(RowSums::total(twice.ulps), 2 * RowSums::total(sums.ulps));
        EXPECT_EQ(twice.maxUlps, sums.maxUlps);
    }
    // One step up at each of nine places, and 2 to 3 at the last.
    std::vector<float> ones(10, 1.0f), above(10, std::nextafter(1.0f, 2.0f));
    ones[9] = 2;
    above[9] = 3;
    RowSums sums, larger;
    addRow(sums, above.data(), ones.data(), 10);
    EXPECT_EQ(RowSums::total(sums.ulps), 9 + (1 << 22));
    EXPECT_EQ(sums.maxUlps, 1 << 22);
    larger.maxUlps = 1 << 23;
    sums.add(larger);
    EXPECT_EQ(sums.maxUlps, 1 << 23);
}

TEST(MetricRows, APixelsErrorIsOfItsLargestComponent) {
    for (int components = 1; components <= 4; ++components) {
        // The error is in the last component, the size in the first; then nothing, and less than the floor.
        std::vector<float> reference(static_cast<std::size_t>(3 * components), 0.0f), test = reference;
        const auto last = static_cast<std::size_t>(components - 1);
        reference[0] = components == 1 ? 4.0f : -4.0f;
        test = reference;
        test[last] += 2;
        test[last + 2 * static_cast<std::size_t>(components)] = -0.25f;
        std::array<float, 3> absolute{}, relative{};
        pixelErrors(absolute.data(), relative.data(), {test.data(), reference.data(), components, 3}, 0.5);
        EXPECT_EQ(absolute, (std::array<float, 3>{2, 0, 0.25f})) << components;
        EXPECT_EQ(relative, (std::array<float, 3>{0.5f, 0, 0.5f})) << components;
    }
    const float low = -most, high = most, nothing = 0;
    float absolute = 0, relative = 0;
    pixelErrors(&absolute, &relative, {&low, &high, 1, 1}, 0);
    EXPECT_EQ(absolute, most) << "the largest float, not infinity";
    EXPECT_EQ(relative, 2);
    pixelErrors(&absolute, &relative, {&nothing, &nothing, 1, 1}, 0);
    EXPECT_EQ(relative, 0) << "0 / 0";
}

TEST(MetricRows, FiniteMeansEveryValue) {
    for (const float bad : {nan, -nan, inf, -inf})
        for (std::size_t at = 0; at < 5; ++at) {
            std::vector<float> values{0, -0.0f, most, -most, std::numeric_limits<float>::denorm_min()};
            EXPECT_TRUE(allFinite(values.data(), 5));
            values[at] = bad;
            EXPECT_FALSE(allFinite(values.data(), 5)) << at;
            EXPECT_TRUE(allFinite(values.data(), static_cast<int>(at))) << "what is before it";
        }
}

// Rec.709 luminance, as sRGB after Reinhard's curve for linear values.
TEST(MetricRows, LumaIsOfRec709) {
    const std::vector<float> rgb{1,   0, 0, 0, 1,   0, 0,     0, 1, -1,    0,     0,
                                 inf, 0, 0, 0, nan, 0, 1e35f, 0, 0, 1e-3f, 1e-3f, 1e-3f};
    std::array<float, 8> display{}, linear{};
    lumaFromDisplay(display.data(), rgb.data(), 8);
    lumaFromLinear(linear.data(), rgb.data(), 8, 2);
    const double lumas[] = {0.2126, 0.7152, 0.0722};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_FLOAT_EQ(display[i], static_cast<float>(lumas[i]));
        const double shown = 2 * lumas[i] / (1 + 2 * lumas[i]);
        EXPECT_NEAR(linear[i], 1.055 * std::pow(shown, 1 / 2.4) - 0.055, 1e-6) << i;
    }
    EXPECT_FLOAT_EQ(display[3], -0.2126f);
    EXPECT_EQ(linear[3], 0) << "negative radiance is black";
    for (const std::size_t i : {4u, 5u}) {
        EXPECT_TRUE(std::isnan(display[i])) << i;
        EXPECT_TRUE(std::isnan(linear[i])) << i;
    }
    EXPECT_NEAR(linear[6], 1, 1e-6) << "past what the curve resolves";
    EXPECT_NEAR(linear[7], 12.92 * (0.002 / 1.002), 1e-6) << "the linear part below 0.0031308";
}

TEST(MetricRows, DistancesOfComponents) {
    using namespace metrics;
    EXPECT_EQ(distance(3.0f, 5.0f), 2);
    EXPECT_EQ(distance(-1.0f, 1.0f), 2);
    EXPECT_EQ(distance(nan, -nan), 0);
    EXPECT_EQ(distance(inf, inf), 0);
    for (const auto& [a, b] :
         {std::pair{inf, -inf}, {1.0f, inf}, {inf, 1.0f}, {nan, 1.0f}, {1.0f, nan}, {nan, inf}})
        EXPECT_EQ(distance(a, b), metrics::infinity);
    const float p[] = {1, -7, nan}, q[] = {3, -6, nan};
    EXPECT_EQ(distance(p, q, 3), 2);
    EXPECT_EQ(largestFinite(p, 3), 7);
    EXPECT_EQ(largestFinite(p + 2, 1), 0);
    EXPECT_TRUE(finite(p, 2));
    EXPECT_FALSE(finite(p, 3));
    const float a[] = {2, 3, 6}, b[] = {0, 3, 4};
    EXPECT_EQ(lengthDifference(a, b), 2) << "7 and 5";
    EXPECT_EQ(lengthDifference(b, a), 2);
    const float x[] = {2, 0, 0}, yz[] = {0, 1, 1}, xyz[] = {1, 1, 1};
    EXPECT_DOUBLE_EQ(metrics::angle(x, yz), 90);
    EXPECT_DOUBLE_EQ(metrics::angle(x, xyz), std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(metrics::angle(yz, xyz), std::acos(std::sqrt(2.0 / 3)) * 180 / std::numbers::pi);
    const float diagonal[] = {1, 2, 3}, other[] = {3, -1, 2};
    EXPECT_DOUBLE_EQ(metrics::angle(diagonal, other), std::acos(7.0 / 14) * 180 / std::numbers::pi);
}

TEST(MetricRows, PowersEndAtTheNormalFloats) {
    constexpr float min = 0x1p-126f;
    EXPECT_EQ(fast::pow(std::nextafter(min, 0.0f), 1), 0);
    EXPECT_NEAR(fast::pow(min, 1) / min, 1, 1e-5);
    EXPECT_NEAR(fast::pow(min, 0.5f) / 0x1p-63f, 1, 1e-5);
    EXPECT_EQ(fast::pow(min, 2), min) << "no less than the least";
    EXPECT_EQ(fast::exp2(0), 1);
    EXPECT_EQ(fast::exp2(-126), min);
    EXPECT_EQ(fast::exp2(127), 0x1p127f);
    for (float x = -3; x <= 3; x += 0.03125f) EXPECT_NEAR(fast::exp2(x) / std::exp2(x), 1, 2.5e-7) << x;
    EXPECT_EQ(fast::log2(1), 0);
    EXPECT_EQ(fast::log2(0x1p-126f), -126);
    EXPECT_EQ(fast::log2(0x1p127f), 127);
}

}  // namespace
}  // namespace diptych
