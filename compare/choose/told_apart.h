// SPDX-License-Identifier: MIT
// Times a few contenders in turn until the fastest is told apart from the others, or they are called equal.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace diptych::choose {

// Times, ms, of drawing contenders in an order: one each, in that order.
using DrawInOrder = std::function<std::vector<double>(std::span<const std::size_t>)>;

struct Standing {
    double ms = 0;  // geometric mean of its times
    // Its time over the winner's, and the confidence interval (toldApartConfidence).
    double ratio = 1, low = 1, high = 1;
    int rounds = 0;
    bool isSlower() const { return low > 1; }
};

// Each comparison's; 99 % rather than 95 % because the interval is looked at after every round.
inline constexpr double toldApartConfidence = 0.99;
// Times within this ratio of each other are equal.
inline constexpr double equalTimes = 1.02;

struct Standings {
    std::vector<Standing> standings;  // of each contender
    std::size_t winner = 0;
    bool sure = false;  // every other contender is slower; else some are equal, or not told apart
    std::size_t draws = 0;
};

// A round draws every contender that is not yet told apart, in an order and in its reverse, so that a drift
// of the device's speed cancels. At least one contender; between `least` and `most` rounds, `least` of them
// in one call of `draw`.
Standings tellApart(std::size_t contenders, const DrawInOrder& draw, int least = 2, int most = 8);

// Student's distribution: |t| exceeds the result with `probability` (0 to 1); `freedom`: 1 or more. By the
// finite series of Abramowitz and Stegun, 26.7.3 and 26.7.4.
double studentT(double probability, int freedom);

}  // namespace diptych::choose
