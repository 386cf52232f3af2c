// SPDX-License-Identifier: MIT
// Finalists with known times, compared under noise and drift.
#include "compare/choose/ranking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace diptych::choose {

namespace {

// Frames that take `ms` with noise, on a device that slows down by a constant fraction per frame.
class SlowingDevice {
public:
    SlowingDevice(std::vector<double> ms, double deviation, double drift, std::uint64_t seed)
        : ms_(std::move(ms)), deviation_(deviation), drift_(drift), random_(seed) {}
    std::vector<double> operator()(std::span<const std::size_t> order) {
        std::vector<double> times;
        for (const std::size_t i : order)
            times.push_back(ms_[i] * std::exp(std::normal_distribution<double>(0, deviation_)(random_)) *
                            (1 + drift_ * frames_++));
        return times;
    }

private:
    std::vector<double> ms_;
    double deviation_, drift_;
    std::mt19937_64 random_;
    double frames_ = 0;
};

Ranking raced(const std::vector<double>& ms, double deviation, double drift, std::uint64_t seed) {
    SlowingDevice device(ms, deviation, drift, seed);
    return rankByTime(ms.size(), [&](std::span<const std::size_t> order) { return device(order); });
}

// 400 pairs of identical candidates: few have a significant winner, and the draw order decides none.
TEST(ChooseRanking, TwoCopiesAreATie) {
    for (const double drift : {0.0, 0.01}) {
        std::size_t winners = 0, first = 0;
        for (std::uint64_t seed = 1; seed <= 400; ++seed) {
            const Ranking result = raced({10, 10}, 0.1, drift, seed);
            winners += result.significant;
            first += result.winner == 0;
        }
        EXPECT_LE(winners, 400 * 0.05) << drift;
        EXPECT_NEAR(static_cast<double>(first), 200.0, 50.0) << "five deviations of a fair coin's 400 throws";
    }
}

// Drift alone makes no difference: each order is also drawn in reverse.
TEST(ChooseRanking, ADriftIsNoDifference) {
    const Ranking result = raced({10, 10, 10}, 0, 0.02, 3);
    for (const TimeRatio& ratio : result.ratios) EXPECT_NEAR(ratio.ratio, 1, 2e-3);
}

TEST(ChooseRanking, EveryDrawIsCounted) {
    std::size_t drawn = 0;
    const auto draw = [&](std::span<const std::size_t> order) {
        drawn += order.size();
        return std::vector<double>(order.size(), 10.0);
    };
    EXPECT_EQ(rankByTime(3, draw).draws, drawn);
    EXPECT_GT(drawn, 0u);
}

TEST(ChooseRanking, TheFastestWinsAndIsSure) {
    std::size_t right = 0, significant = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Ranking result = raced({12, 10, 13, 11.5, 20}, 0.05, 0.002, seed);
        right += result.winner == 1;
        significant += result.significant;
        EXPECT_LE(result.ratios[4].pairs, result.ratios[1].pairs) << "the slowest does not run to the end";
    }
    EXPECT_GE(right, 196u);
    EXPECT_GE(significant, 180u);
}

}  // namespace

}  // namespace diptych::choose
