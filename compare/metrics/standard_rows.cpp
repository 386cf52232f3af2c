// SPDX-License-Identifier: MIT
#include "compare/metrics/standard_rows.h"

#include "compare/metrics/fast_math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace diptych {
namespace {

constexpr int lanes = 8;

// Integers that sort like the floats; -0 and 0 are both 0.
inline std::int32_t ordered(float v) {
    const auto bits = std::bit_cast<std::int32_t>(v);
    return bits < 0 ? std::numeric_limits<std::int32_t>::min() - bits : bits;
}

inline float largest(const float* p, int components) {
    float max = std::abs(p[0]);
    for (int c = 1; c < components; ++c) max = std::abs(p[c]) > max ? std::abs(p[c]) : max;
    return max;
}

template <int components>
void errorsOf(float* __restrict absolute, float* __restrict relative, const float* __restrict test,
              const float* __restrict reference, double floor, int n) {
    constexpr double longest = std::numeric_limits<float>::max();
    for (int i = 0; i < n; ++i) {
        const float *t = test + components * i, *r = reference + components * i;
        double max = 0;
        for (int c = 0; c < components; ++c) {
            const double d = std::abs(double{t[c]} - double{r[c]});
            max = d > max ? d : max;
        }
        const double size = largest(r, components), against = size > floor ? size : floor;
        absolute[i] = static_cast<float>(max < longest ? max : longest);
        relative[i] = max > 0 ? static_cast<float>(max / against) : 0.0f;
    }
}

inline float luminance(const float* p) {
    return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
}

// IEC 61966-2-1.
inline float srgbFromLinear(float v) {
    const float curve = 1.055f * fast::pow(v, 1 / 2.4f) - 0.055f;
    return v <= 0.0031308f ? 12.92f * v : curve;
}

}  // namespace

void RowSums::add(const RowSums& other) {
    for (std::size_t i = 0; i < lanes; ++i) {
        absolute[i] += other.absolute[i];
        squared[i] += other.squared[i];
        relative[i] += other.relative[i];
        ulps[i] += other.ulps[i];
    }
    maxUlps = std::max(maxUlps, other.maxUlps);
}

double RowSums::total(const std::array<double, 8>& s) {
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

DIPTYCH_WIDE_LANES void addRow(RowSums& sums, const float* __restrict test, const float* __restrict reference,
                               int n) {
    double absolute[lanes]{}, squared[lanes]{}, relative[lanes]{}, ulps[lanes]{}, max[lanes]{};
    const auto add = [&](int l, float t, float r) {
        const double d = double{t} - double{r}, square = d * d;
        const double steps = std::abs(static_cast<double>(ordered(t)) - static_cast<double>(ordered(r)));
        absolute[l] += std::abs(d);
        squared[l] += square;
        relative[l] += square / (double{r} * double{r} + 0.01);
        ulps[l] += steps;
        max[l] = steps > max[l] ? steps : max[l];
    };
    int i = 0;
    for (; i + lanes <= n; i += lanes)
        for (int l = 0; l < lanes; ++l) add(l, test[i + l], reference[i + l]);
    for (int l = 0; i + l < n; ++l) add(l, test[i + l], reference[i + l]);
    for (std::size_t l = 0; l < lanes; ++l) {
        sums.absolute[l] += absolute[l];
        sums.squared[l] += squared[l];
        sums.relative[l] += relative[l];
        sums.ulps[l] += ulps[l];
        sums.maxUlps = std::max(sums.maxUlps, max[l]);
    }
}

void pixelErrors(float* absolute, float* relative, const PixelRow& row, double floor) {
    switch (row.components) {
        case 1:
            return errorsOf<1>(absolute, relative, row.test, row.reference, floor, row.pixels);
        case 2:
            return errorsOf<2>(absolute, relative, row.test, row.reference, floor, row.pixels);
        case 3:
            return errorsOf<3>(absolute, relative, row.test, row.reference, floor, row.pixels);
        default:
            return errorsOf<4>(absolute, relative, row.test, row.reference, floor, row.pixels);
    }
}

DIPTYCH_WIDE_LANES bool allFinite(const float* values, int n) {
    std::uint32_t max = 0;
    for (int i = 0; i < n; ++i) {
        const std::uint32_t magnitude = std::bit_cast<std::uint32_t>(values[i]) & 0x7fffffffu;
        max = magnitude > max ? magnitude : max;
    }
    return max < 0x7f800000u;
}

DIPTYCH_WIDE_LANES void lumaFromDisplay(float* __restrict out, const float* __restrict rgb, int n) {
    for (int i = 0; i < n; ++i) {
        const float l = luminance(rgb + 3 * i);
        out[i] = l + 0.0f * (l - l);  // infinity becomes NaN
    }
}

DIPTYCH_WIDE_LANES void lumaFromLinear(float* __restrict out, const float* __restrict rgb, int n,
                                       float scale) {
    for (int i = 0; i < n; ++i) {
        const float l = luminance(rgb + 3 * i);
        float positive = l < 0 ? 0.0f : l * scale;
        positive = positive > 1e30f ? 1e30f : positive;
        out[i] = srgbFromLinear(1 - 1 / (1 + positive)) + 0.0f * (l - l);
    }
}

}  // namespace diptych
