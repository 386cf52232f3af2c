// SPDX-License-Identifier: MIT
// Steps of the simplex, counted by evaluations: a reflected corner takes one, a contracted one two.
#include "shared/light/fit/nelder_mead.h"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::ltc {
namespace {

// The first simplex is (0, 0), (1, 0), (0, 1), whose worst corner is (1, 0): mirrored, it is (-1, 1).
constexpr Point<2> worst{1, 0}, mirrored{-1, 1};

int evaluations(double ofMirrored) {
    int count = 0;
    nelderMead<2>(
        [&](const Point<2>& x) {
            ++count;
            if (x == worst) return 4.0;
            if (x == mirrored) return ofMirrored;
            return 1 + x[1];  // 1 and 2
        },
        {0, 0}, 1, 0, 1);
    return count;
}

TEST(NelderMead, ACornerBetterThanTheSecondWorstIsTaken) {
    EXPECT_EQ(evaluations(1.5), 3 + 1);
    EXPECT_EQ(evaluations(0.5), 3 + 2) << "better than the best: expanded";
    EXPECT_EQ(evaluations(2.5), 3 + 2) << "contracted outside";
    EXPECT_EQ(evaluations(5), 3 + 2) << "contracted inside";
}

TEST(NelderMead, FollowsTheCurvedValley) {
    const Point<2> found = nelderMead<2>(
        [](const Point<2>& x) { return 1 + 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2); },
        {-1.2, 1}, 0.5, 1e-14, 500);
    EXPECT_NEAR(found[0], 1, 1e-5);
    EXPECT_NEAR(found[1], 1, 1e-5);
}

}  // namespace
}  // namespace diptych::ltc
