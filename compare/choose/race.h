// SPDX-License-Identifier: MIT
// Which of some contenders takes the least time, by times that are paired: all of them in each round, in
// random order and then in the reverse one (ABBA), so that a drift of the device's speed falls on all alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace diptych::choose {

// Times, ms, of drawing contenders in an order: one each, in that order.
using DrawInOrder = std::function<std::vector<double>(std::span<const std::size_t>)>;

struct RaceRules {
    // That a race names a winner among equals, at most.
    double false_winner = 0.02;
    // Within this ratio of each other two times are one: nobody chooses by less.
    double tie = 0.02;
    // Rounds after which it is decided who goes on: at most half of them, the faster, and two at least.
    std::vector<int> rungs{2, 4, 8, 12};
};

struct Standing {
    double ms = 0;  // geometric mean of its times
    // Of its time to the winner's, in the rounds that both ran, and the interval that holds it with the
    // confidence of the race: of all comparisons together.
    double ratio = 1, low = 1, high = 1;
    int rounds = 0;
    bool isSlower() const { return low > 1; }
};

struct Race {
    std::vector<Standing> standings;  // of each contender
    std::size_t winner = 0;           // the fastest in the mean of those that ran to the end
    // Every other one is slower beyond chance. Else some tie with the winner.
    bool sure = false;
    std::size_t draws = 0;
};

// At least one contender. `seed`: of the orders.
Race race(std::size_t contenders, const DrawInOrder& draw, const RaceRules& rules, std::uint64_t seed);

// Of Student's distribution: what |t| exceeds with a probability, 0 to 1; `freedom`: 1 or more. By the finite
// series of Abramowitz and Stegun, 26.7.3 and 26.7.4.
double studentT(double probability, int freedom);

}  // namespace diptych::choose
