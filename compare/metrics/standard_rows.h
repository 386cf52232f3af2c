// SPDX-License-Identifier: MIT
// Sums over two rows of finite components.
#pragma once

#include <array>
#include <cstdint>

namespace diptych {

// Eight interleaved partial sums, added in a fixed order, so that the result does not depend on the vector
// width.
struct RowSums {
    std::array<double, 8> absolute{}, squared{}, relative{}, ulps{};
    double maxUlps = 0;
    void add(const RowSums& other);
    static double total(const std::array<double, 8>& sums);
};

// Adds n finite components: |t-r|, (t-r)^2, (t-r)^2 / (r^2 + 0.01) and the distance in float32 values,
// whose sums are exact up to 2^53.
void addRow(RowSums& sums, const float* test, const float* reference, int n);

// Pixels of 1 to 4 finite components.
struct PixelRow {
    const float *test, *reference;
    int components, pixels;
};
// Per pixel: the largest |t-r|, and that over max(largest |r|, floor), 0 / 0 being 0.
void pixelErrors(float* absolute, float* relative, const PixelRow& row, double floor);

// Whether all n values are finite.
bool allFinite(const float* values, int n);

// Luma of n RGB pixels. Display values: directly. Linear values: sRGB value of Reinhard's curve of `scale`
// times their luminance. NaN if a component is non-finite.
void lumaFromDisplay(float* out, const float* rgb, int n);
void lumaFromLinear(float* out, const float* rgb, int n, float scale);

}  // namespace diptych
