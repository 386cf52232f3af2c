// SPDX-License-Identifier: MIT
// The weights of FLIP's filters for one viewing distance. All are products of a filter along x and one along
// y, or a sum of two such.
#pragma once

#include <array>
#include <vector>

namespace diptych {

// Weights at 0 .. radius, radius = size() - 1. The weight at -k is that at k, negated for odd filters.
using HalfKernel = std::vector<float>;

struct FlipFilters {
    explicit FlipFilters(double pixelsPerDegree);

    // The contrast sensitivity of the eye for y, cx and cz (2020 paper, section 4.1.1). Each adds up to 1.
    HalfKernel y, cx;
    std::array<HalfKernel, 2> cz;     // in both directions
    std::array<float, 2> cz_share{};  // of the first and the second; add up to 1
    // A Gaussian, its first derivative (weights above 0 add up to 1, those below to -1), its second likewise
    // (section 4.2).
    HalfKernel smooth, edge, point;

    int radius() const;  // of the widest
};

}  // namespace diptych
