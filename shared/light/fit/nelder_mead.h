// SPDX-License-Identifier: MIT
// Nelder and Mead 1965, "A Simplex Method for Function Minimization", with their coefficients: reflection 1,
// expansion 2, contraction and shrinkage 1/2.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace diptych::ltc {

template <std::size_t N>
using Point = std::array<double, N>;

// A local minimum of f near `start`; the initial simplex has edges of `step`. Stops when the values at the
// corners agree to `relative` of the smallest, or after `max` steps.
template <std::size_t N, class F>
Point<N> nelderMead(const F& f, const Point<N>& start, double step, double relative, int max) {
    struct Corner {
        Point<N> x;
        double value;
    };
    std::array<Corner, N + 1> simplex;
    for (std::size_t i = 0; i <= N; ++i) {
        simplex[i].x = start;
        if (i > 0) simplex[i].x[i - 1] += step;
        simplex[i].value = f(simplex[i].x);
    }
    for (int n = 0;; ++n) {
        std::ranges::stable_sort(simplex, {}, &Corner::value);
        Corner &best = simplex.front(), &worst = simplex.back();
        if (n >= max || worst.value - best.value <= relative * best.value) return best.x;

        Point<N> middle{};  // of all corners but the worst
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t k = 0; k < N; ++k) middle[k] += simplex[i].x[k] / N;
        const auto from = [&](double t) {  // 0: the centre, 1: the worst corner
            Corner corner;
            for (std::size_t k = 0; k < N; ++k) corner.x[k] = middle[k] + t * (worst.x[k] - middle[k]);
            corner.value = f(corner.x);
            return corner;
        };
        const Corner reflected = from(-1);
        if (reflected.value < best.value) {
            const Corner expanded = from(-2);
            worst = expanded.value < reflected.value ? expanded : reflected;
        } else if (reflected.value < simplex[N - 1].value) {
            worst = reflected;
        } else {
            const Corner contracted = from(reflected.value < worst.value ? -0.5 : 0.5);
            if (contracted.value < std::min(reflected.value, worst.value)) {
                worst = contracted;
                continue;
            }
            for (std::size_t i = 1; i <= N; ++i) {
                for (std::size_t k = 0; k < N; ++k) simplex[i].x[k] = 0.5 * (simplex[i].x[k] + best.x[k]);
                simplex[i].value = f(simplex[i].x);
            }
        }
    }
}

}  // namespace diptych::ltc
