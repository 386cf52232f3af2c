// SPDX-License-Identifier: MIT
// Times a few finalists, interleaved, until the fastest is significantly faster or all count as equal.
#pragma once

#include "compare/experiment/intervals.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace diptych::choose {

using experiment::TimeRatio;

// Renders finalists in the given order; returns one time per entry, ms.
using DrawInOrder = std::function<std::vector<double>(std::span<const std::size_t>)>;

// Per comparison. 99 % instead of 95 %, because the test repeats after every round.
inline constexpr double rankingConfidence = 0.99;
// Times within this ratio count as equal.
inline constexpr double equalTimes = 1.02;

struct Ranking {
    std::vector<double> ms;         // by finalist; geometric means
    std::vector<TimeRatio> ratios;  // by finalist: time over the winner's
    std::size_t winner = 0;
    bool significant = false;  // all others are significantly slower
    std::size_t draws = 0;
};

// A ranking by indices of candidates.
struct Race {
    std::optional<std::size_t> chosen, runner_up;  // fastest, second fastest
    std::vector<std::size_t> ties;                 // not significantly slower than the chosen one
    bool significant = false;                      // all others are significantly slower
};
// `finalists`: the ranked candidates.
Race raceOf(const Ranking& ranking, std::span<const std::size_t> finalists);

// Each round renders every remaining finalist in an order and its reverse, which cancels a drift of the
// device's speed. Needs at least one finalist. Runs `min` to `max` rounds; the first call of `draw`
// has `min` rounds.
Ranking rankByTime(std::size_t finalists, const DrawInOrder& draw, int min = 2, int max = 8);

}  // namespace diptych::choose
