// SPDX-License-Identifier: MIT
// Two images for which every metric differs from every other, and the metrics by their definitions.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace diptych::error_spread {

using Metrics = std::map<std::string, double>;

// 61 x 41 pixels, 2001 of them covered. The ranks 0.99 x 2001 = 1980.99 and 0.999 x 2001 = 1998.999 are
// not integers: rounding down or counting from 0 selects another pixel. Pixel spreadPixel(i) has the i-th
// smallest error; uncovered pixels have far larger errors.
inline constexpr int wide = 61, high = 41;
inline constexpr std::size_t counted = 2001, everywhere = std::size_t{wide} * high;

inline std::size_t spreadPixel(std::size_t i) {
    return i * 617 % everywhere;  // 617 has no common factor with 61 or 41
}
inline double stepOf(std::size_t i) {
    return static_cast<double>(i + 1) * 0x1p-12;
}
inline double magnitudeOf(std::size_t i) {
    return 1 + 0.5 * static_cast<double>((i + 3) % 5);
}

struct Spread {
    Image reference{wide, high, 3}, test{wide, high, 3};
    Coverage covered{std::vector<std::uint8_t>(everywhere, 0), counted, true};
};

// Error of component 0: the pixel's step; of 1: -1/2 step; of 2: 1/8 step. Every value is exact.
inline Spread spread() {
    Spread s;
    for (std::size_t i = 0; i < everywhere; ++i) {
        const bool counts = i < counted;
        const double step = counts ? stepOf(i) : 1000, size = magnitudeOf(i);
        float *r = s.reference.pixel(spreadPixel(i)), *t = s.test.pixel(spreadPixel(i));
        for (const auto& [c, of, by] : {std::tuple{0, 1.0, 1.0}, {1, 0.5, -0.5}, {2, 0.25, 0.125}}) {
            r[c] = static_cast<float>(size * of);
            t[c] = static_cast<float>(size * of + step * by);
        }
        s.covered.covered[spreadPixel(i)] = counts;
    }
    return s;
}

inline double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}
inline double rootMeanSquareOf(std::vector<double> values) {
    for (double& v : values) v *= v;
    return std::sqrt(meanOf(values));
}
// The percentiles' ranks, from 1: ceil(0.99 x 2001) = 1981, ceil(0.999 x 2001) = 1999.
inline double errorOfRank(std::vector<double> values, std::size_t rank) {
    std::ranges::sort(values);
    return values.at(rank - 1);
}

inline double angleBetween(const float* a, const float* b) {
    const double x = double{a[1]} * b[2] - double{a[2]} * b[1], y = double{a[2]} * b[0] - double{a[0]} * b[2],
                 z = double{a[0]} * b[1] - double{a[1]} * b[0];
    const double along = double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
    return std::atan2(std::sqrt(x * x + y * y + z * z), along) * 180 / std::numbers::pi;
}

// Errors of the covered pixels.
struct Errors {
    std::vector<double> absolute, relative, angles, components, relative_squares, ulps;
};
inline Errors errorsOf(const Spread& s) {
    Errors e;
    for (std::size_t i = 0; i < counted; ++i) {
        const float *r = s.reference.pixel(spreadPixel(i)), *t = s.test.pixel(spreadPixel(i));
        e.absolute.push_back(stepOf(i));
        e.relative.push_back(stepOf(i) / magnitudeOf(i));  // of the largest component, far above the floor
        e.angles.push_back(angleBetween(t, r));
        for (int c = 0; c < 3; ++c) {
            const double d = double{t[c]} - double{r[c]};
            e.components.push_back(std::abs(d));
            e.relative_squares.push_back(d * d / (double{r[c]} * r[c] + 0.01));
            // The bit patterns of two positive floats differ by their distance in ULP.
            e.ulps.push_back(std::abs(static_cast<double>(std::bit_cast<std::int32_t>(t[c])) -
                                      static_cast<double>(std::bit_cast<std::int32_t>(r[c]))));
        }
    }
    return e;
}

// Metrics of one kind of pixel error.
inline Metrics ofPixels(const std::vector<double>& errors) {
    return {{"max", errorOfRank(errors, counted)},
            {"mean", meanOf(errors)},
            {"rmse", rootMeanSquareOf(errors)},
            {"p99", errorOfRank(errors, 1981)},
            {"p999", errorOfRank(errors, 1999)}};
}

}  // namespace diptych::error_spread
