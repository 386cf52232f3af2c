// SPDX-License-Identifier: MIT
#include "compare/choose/ranking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace diptych::choose {

namespace {

// P(|T| <= t) of Student's t distribution.
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

double meanOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Mean and half-width of the confidence interval of a - b, over the rounds of both.
struct Difference {
    double mean = 0, half_width = 0;
};
Difference differenceOf(std::span<const double> a, std::span<const double> b) {
    std::vector<double> differences(std::min(a.size(), b.size()));
    for (std::size_t k = 0; k < differences.size(); ++k) differences[k] = a[k] - b[k];
    const double mean = meanOf(differences);
    if (differences.size() < 2) return {mean, std::numeric_limits<double>::infinity()};
    double squares = 0;
    for (const double each : differences) squares += (each - mean) * (each - mean);
    const auto n = static_cast<double>(differences.size());
    const double t = studentT(1 - rankingConfidence, static_cast<int>(differences.size()) - 1);
    return {mean, t * std::sqrt(squares / (n - 1) / n)};
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

Ranking rankByTime(std::size_t finalists, const DrawInOrder& draw, int least, int most) {
    Ranking result;
    result.finalists.resize(finalists);
    std::vector<std::size_t> running(finalists);
    std::iota(running.begin(), running.end(), std::size_t{0});
    std::vector<std::vector<double>> rounds(finalists);  // log of the geometric mean of both draws
    int done = 0;
    while (done < most) {
        std::vector<std::size_t> order;
        const int until = std::max(done + 1, least);
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
            const auto [mean, half_width] = differenceOf(rounds[i], rounds[result.winner]);
            const bool slower = mean - half_width > 0;
            equal = equal && (slower || mean + half_width < std::log(equalTimes));
            return slower;
        });
        if (equal) break;
    }
    result.significant = true;
    for (std::size_t i = 0; i < finalists; ++i) {
        FinalistTime& race_time = result.finalists[i];
        race_time.rounds = static_cast<int>(rounds[i].size());
        race_time.ms = std::exp(meanOf(rounds[i]));
        if (i == result.winner) continue;
        const auto [mean, half_width] = differenceOf(rounds[i], rounds[result.winner]);
        race_time.ratio = std::exp(mean);
        race_time.low = std::exp(mean - half_width);
        race_time.high = std::exp(mean + half_width);
        result.significant = result.significant && race_time.isSlower();
    }
    return result;
}

}  // namespace diptych::choose
