// SPDX-License-Identifier: MIT
#include "compare/choose/ranking.h"

#include "compare/experiment/intervals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diptych::choose {

using experiment::meanDifference;
using experiment::meanOf;

Ranking rankByTime(std::size_t finalists, const DrawInOrder& draw, int min, int max) {
    Ranking result;
    std::vector<std::size_t> running(finalists);
    std::iota(running.begin(), running.end(), std::size_t{0});
    std::vector<std::vector<double>> rounds(finalists);  // log of the geometric mean of both draws
    int done = 0;
    while (done < max) {
        std::vector<std::size_t> order;
        const int until = std::max(done + 1, min);
        for (int round = done; round < until; ++round) {
            order.insert(order.end(), running.begin(), running.end());
            order.insert(order.end(), running.rbegin(), running.rend());
        }
        const std::vector<double> times = draw(order);
        result.draws += times.size();
        for (std::size_t at = 0; done < until; ++done) {
            std::vector<double> sums(finalists, 0.0);
            for (std::size_t k = 0; k < 2 * running.size(); ++k, ++at)
                sums[order[at]] += 0.5 * std::log(std::max(times[at], 1e-9));
            for (const std::size_t i : running) rounds[i].push_back(sums[i]);
        }
        result.winner =
            *std::ranges::min_element(running, {}, [&](std::size_t i) { return meanOf(rounds[i]); });
        bool equal = true;
        std::erase_if(running, [&](std::size_t i) {
            if (i == result.winner) return false;
            const auto [mean, half_width] =
                meanDifference(rounds[i], rounds[result.winner], 1 - rankingConfidence);
            const bool slower = mean - half_width > 0;
            equal = equal && (slower || mean + half_width < std::log(equalTimes));
            return slower;
        });
        if (equal) break;
    }
    result.significant = true;
    for (std::size_t i = 0; i < finalists; ++i) {
        result.ms.push_back(std::exp(meanOf(rounds[i])));
        const bool won = i == result.winner;
        result.ratios.push_back(
            won ? TimeRatio{.confidence = rankingConfidence, .pairs = static_cast<int>(rounds[i].size())}
                : experiment::meanRatio(rounds[i], rounds[result.winner], 1 - rankingConfidence));
        result.significant = result.significant && (won || result.ratios.back().isSlower());
    }
    return result;
}

Race raceOf(const Ranking& ranking, std::span<const std::size_t> finalists) {
    Race race;
    race.chosen = finalists[ranking.winner];
    race.significant = ranking.significant;
    std::optional<std::size_t> second;
    for (std::size_t k = 0; k < finalists.size(); ++k) {
        if (k == ranking.winner) continue;
        if (!ranking.ratios[k].isSlower()) race.ties.push_back(finalists[k]);
        if (!second || ranking.ratios[k].ratio < ranking.ratios[*second].ratio) second = k;
    }
    if (second) race.runner_up = finalists[*second];
    return race;
}

}  // namespace diptych::choose
