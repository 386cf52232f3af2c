// SPDX-License-Identifier: MIT
// Weights of FLIP's filters for one viewing distance. Each filter is separable, or a sum of two separable
// ones.
#pragma once

#include <array>
#include <vector>

namespace diptych {

// Weights at 0 .. radius, radius = size() - 1. The weight at -k equals that at k, negated for odd filters.
using HalfKernel = std::vector<float>;

struct FlipFilters {
    explicit FlipFilters(double pixelsPerDegree);

    // Contrast sensitivity of the eye for y, cx and cz (2020 paper, section 4.1.1); each adds up to 1.
    HalfKernel y, cx;
    std::array<HalfKernel, 2> cz;        // two separable terms, each for both directions
    std::array<float, 2> cz_fraction{};  // fractions of the two terms; add up to 1
    // A Gaussian and its first and second derivatives (section 4.2). The derivatives' positive weights add
    // up to 1, the negative ones to -1.
    HalfKernel smooth, edge, point;

    int radius() const;  // of the widest
};

}  // namespace diptych
