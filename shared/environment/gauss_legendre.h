// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace diptych {

// Gauss-Legendre nodes and weights on [0, 1], by Newton's method from Tricomi's estimate of the roots.
struct GaussLegendre {
    static constexpr std::size_t points = 16;
    std::array<double, points> at{}, weight{};

    GaussLegendre() {
        constexpr double n = points;
        for (std::size_t i = 0; i < points; ++i) {
            double z = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 0;
            for (int step = 0; step < 100; ++step) {
                double p = 1, before = 0;
                for (double j = 0; j < n; ++j) {
                    const double last = before;
                    before = p;
                    p = ((2 * j + 1) * z * before - j * last) / (j + 1);
                }
                slope = n * (z * p - before) / (z * z - 1);
                const double move = p / slope;
                z -= move;
                if (std::abs(move) < 1e-15) break;
            }
            at[i] = (1 - z) / 2;
            weight[i] = 1 / ((1 - z * z) * slope * slope);
        }
    }
};

}  // namespace diptych
