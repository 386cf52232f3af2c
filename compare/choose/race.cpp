// SPDX-License-Identifier: MIT
#include "compare/choose/race.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

namespace diptych::choose {

namespace {

// P(|T| <= t).
double within(double t, int freedom) {
    const double angle = std::atan(t / std::sqrt(static_cast<double>(freedom)));
    const double c = std::cos(angle), s = std::sin(angle);
    double term = freedom % 2 == 1 ? c : 1, sum = freedom == 1 ? 0 : term;
    for (int k = freedom % 2 == 1 ? 3 : 2; k < freedom; k += 2) {
        term *= c * c * (k - 1) / k;
        sum += term;
    }
    return freedom % 2 == 1 ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

// Logarithms of one contender's times, one a round: the mean of both draws.
using Rounds = std::vector<double>;

double meanOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Of every contender to one of them, over the rounds that both ran: the logarithm of the ratio and half its
// interval. The variance of a round's ratio is taken for that of all, so that a contender that ran few rounds
// is judged by what the others tell of the noise.
struct Paired {
    double mean = 0, half = std::numeric_limits<double>::infinity();
};
std::vector<Paired> pairedTo(std::size_t winner, const std::vector<Rounds>& rounds, double doubt) {
    std::vector<Paired> result(rounds.size());
    double squares = 0;
    std::size_t freedom = 0;
    const auto together = [&](std::size_t i) { return std::min(rounds[i].size(), rounds[winner].size()); };
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        if (i == winner) continue;
        std::vector<double> ratios(together(i));
        for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = rounds[i][k] - rounds[winner][k];
        result[i].mean = meanOf(ratios);
        for (const double ratio : ratios) squares += (ratio - result[i].mean) * (ratio - result[i].mean);
        freedom += ratios.size() - 1;
    }
    if (freedom == 0) return result;
    const double t = studentT(doubt, static_cast<int>(freedom));
    for (std::size_t i = 0; i < rounds.size(); ++i)
        result[i].half =
            t * std::sqrt(squares / static_cast<double>(freedom) / static_cast<double>(together(i)));
    return result;
}

}  // namespace

double studentT(double probability, int freedom) {
    double low = 0, high = 1;
    while (within(high, freedom) < 1 - probability && high < 1e12) high *= 2;
    for (int i = 0; i < 100 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        (within(middle, freedom) < 1 - probability ? low : high) = middle;
    }
    return high;
}

Race race(std::size_t contenders, const DrawInOrder& draw, const RaceRules& rules, std::uint64_t seed) {
    Race result;
    result.standings.resize(contenders);
    std::vector<std::size_t> running(contenders);
    std::iota(running.begin(), running.end(), std::size_t{0});
    std::vector<Rounds> rounds(contenders);
    std::mt19937_64 random(seed);
    // Every comparison at every rung may err (Bonferroni).
    const double doubt = rules.false_winner / static_cast<double>(rules.rungs.size()) /
                         static_cast<double>(std::max<std::size_t>(contenders, 2) - 1);
    int done = 0;
    for (const int rung : rules.rungs) {
        std::vector<std::size_t> order;
        for (int round = done; round < rung; ++round) {
            std::ranges::shuffle(running, random);
            order.insert(order.end(), running.begin(), running.end());
            order.insert(order.end(), running.rbegin(), running.rend());
        }
        const std::vector<double> times = draw(order);
        result.draws += times.size();
        for (std::size_t at = 0; done < rung; ++done) {
            std::vector<double> sums(contenders, 0.0);
            for (std::size_t k = 0; k < 2 * running.size(); ++k, ++at)
                sums[order[at]] += 0.5 * std::log(std::max(times[at], 1e-9));
            for (const std::size_t i : running) rounds[i].push_back(sums[i]);
        }
        std::ranges::sort(running, {}, [&](std::size_t i) { return meanOf(rounds[i]); });
        result.winner = running.front();
        const std::vector<Paired> ratios = pairedTo(result.winner, rounds, doubt);
        bool decided = true, tied = true;  // every one of these is slower, or as fast as nobody cares
        std::vector<std::size_t> left;
        for (const std::size_t i : running) {
            const Paired& to = ratios[i];
            const bool slower = i != result.winner && to.mean - to.half > 0;
            const bool equal = std::abs(to.mean) + to.half < std::log1p(rules.tie);
            if (!slower) left.push_back(i);
            decided = decided && (slower || i == result.winner);
            tied = tied && (slower || equal || i == result.winner);
        }
        if (decided || tied) break;
        left.resize(std::min(left.size(), std::max<std::size_t>(2, (running.size() + 1) / 2)));
        running = std::move(left);
    }
    const std::vector<Paired> ratios = pairedTo(result.winner, rounds, doubt);
    result.sure = true;
    for (std::size_t i = 0; i < contenders; ++i) {
        Standing& standing = result.standings[i];
        standing.rounds = static_cast<int>(rounds[i].size());
        standing.ms = std::exp(meanOf(rounds[i]));
        if (i == result.winner) continue;
        const Paired& to = ratios[i];
        standing.ratio = std::exp(to.mean);
        standing.low = std::exp(to.mean - to.half);
        standing.high = std::exp(to.mean + to.half);
        result.sure = result.sure && standing.isSlower();
    }
    return result;
}

}  // namespace diptych::choose
