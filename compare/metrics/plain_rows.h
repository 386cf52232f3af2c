// SPDX-License-Identifier: MIT
// Sums of two rows of finite components.
#pragma once

#include <array>
#include <cstdint>

namespace diptych {

// Eight partial sums that are used in turn and added in a fixed order, so that the result does not depend on
// the width of vector lanes.
struct RowSums {
    std::array<double, 8> absolute{}, squared{}, relative{}, ulps{};
    double mostUlps = 0;
    void add(const RowSums& other);
    static double total(const std::array<double, 8>& sums);
};

// Adds n components, all finite: |t-r|, (t-r)^2, (t-r)^2 / (r^2 + 0.01) and the distance in float32 values.
// The sums of whole numbers are exact up to 2^53.
void addRow(RowSums& sums, const float* test, const float* reference, int n);

// Per pixel of 1 to 4 finite components: the largest |t-r|, and that over max(largest |r|, floor); 0 where
// both are. n pixels.
void pixelErrors(float* absolute, float* relative, const float* test, const float* reference, int components,
                 double floor, int n);

// Whether all n are finite.
bool allFinite(const float* values, int n);

// Luma of n RGB pixels of display values; or, of linear ones, of what Reinhard's curve shows of `scale` times
// their luminance, as an sRGB value. NaN where a component is nonfinite.
void lumaFromDisplay(float* out, const float* rgb, int n);
void lumaFromLinear(float* out, const float* rgb, int n, float scale);

}  // namespace diptych
