// SPDX-License-Identifier: MIT
// Gauss-Legendre quadrature with sixteen points.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace diptych::reference {

class GaussLegendre {
public:
    static constexpr int points = 16;

    static const GaussLegendre& rule() {
        static const GaussLegendre made;
        return made;
    }
    std::array<double, points> at{}, weight{};  // on (0, 1)

private:
    // Sign changes on a grid bracket the roots; Newton's method refines them.
    GaussLegendre() {
        constexpr int grid = 4000;
        int found = 0;
        for (int i = 0; i < grid && found < points; ++i) {
            double low = -1 + (2.0 * i + 0.5) / grid, high = low + 2.0 / grid;
            if (std::signbit(legendre(low)[0]) == std::signbit(legendre(high)[0])) continue;
            double x = (low + high) / 2;
            for (int step = 0; step < 20; ++step) {
                const auto [p, slope] = legendre(x);
                x -= p / slope;
            }
            const double slope = legendre(x)[1];
            at[static_cast<std::size_t>(found)] = (1 + x) / 2;
            weight[static_cast<std::size_t>(found++)] = 1 / ((1 - x * x) * slope * slope);
        }
    }
    // The Legendre polynomial of the rule's degree, and its derivative.
    static std::array<double, 2> legendre(double x) {
        double before = 1, p = x;
        for (int k = 2; k <= points; ++k) {
            const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
            before = p;
            p = next;
        }
        return {p, points * (x * p - before) / (x * x - 1)};
    }
};

// Calls f(x, dx) at every point of the rule in each of `parts` equal parts of an interval.
template <class F>
void eachPoint(double from, double to, const F& f, int parts = 1) {
    const GaussLegendre& rule = GaussLegendre::rule();
    for (int part = 0; part < parts; ++part) {
        const double low = from + (to - from) * part / parts, width = (to - from) / parts;
        for (std::size_t i = 0; i < GaussLegendre::points; ++i)
            f(low + width * rule.at[i], width * rule.weight[i]);
    }
}

}  // namespace diptych::reference
