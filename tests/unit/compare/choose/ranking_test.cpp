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

// The runner-up has the least ratio; ties are all that are not surely slower.
TEST(ChooseRanking, ARaceNamesWinnerRunnerUpAndTies) {
    const auto ratio = [](double value, double low) {
        TimeRatio made;
        made.ratio = value;
        made.low = low;
        made.high = 2 * value - low;
        return made;
    };
    const std::vector<std::size_t> finalists{7, 5, 9, 3};
    const Ranking ranking{{}, {ratio(1.5, 1.25), {}, ratio(1.25, 0.75), ratio(1.375, 1.125)}, 1, false, 0};
    ASSERT_TRUE(ranking.ratios[0].isSlower());
    ASSERT_FALSE(ranking.ratios[2].isSlower());
    Race race = raceOf(ranking, finalists);
    EXPECT_EQ(race.chosen, 5u);
    EXPECT_EQ(race.runner_up, 9u);
    EXPECT_EQ(race.ties, std::vector<std::size_t>{9});
    EXPECT_FALSE(race.significant);
    Ranking sure = ranking;
    sure.ratios[2] = ratio(1.375, 1.125);
    sure.significant = true;
    race = raceOf(sure, finalists);
    EXPECT_EQ(race.runner_up, 9u) << "the first of equals";
    EXPECT_TRUE(race.ties.empty());
    EXPECT_TRUE(race.significant);
    race = raceOf({{}, {{}}, 0, true, 0}, std::vector<std::size_t>{4});
    EXPECT_EQ(race.chosen, 4u);
    EXPECT_FALSE(race.runner_up.has_value());
}

// Alone, a finalist wins after the least number of rounds; copies that are equal end the race then, too.
TEST(ChooseRanking, ARaceEndsWhenItIsDecided) {
    std::vector<std::size_t> asked;
    const auto draw = [&](std::span<const std::size_t> order) {
        asked.push_back(order.size());
        std::vector<double> times;
        for (const std::size_t i : order) times.push_back(i == 2 ? 20.0 : 10.0);
        return times;
    };
    const Ranking one = rankByTime(1, draw, 3, 8);
    EXPECT_EQ(asked, std::vector<std::size_t>{6});
    EXPECT_TRUE(one.significant);
    EXPECT_EQ(one.draws, 6u);
    EXPECT_NEAR(one.ms.at(0), 10, 1e-9);
    EXPECT_EQ(one.ratios.at(0).pairs, 3);
    asked.clear();
    const Ranking three = rankByTime(3, draw, 2, 8);
    EXPECT_EQ(asked, std::vector<std::size_t>{12});
    EXPECT_EQ(three.winner, 0u);
    EXPECT_FALSE(three.significant) << "two are equal";
    EXPECT_NEAR(three.ms.at(2), 20, 1e-9);
    EXPECT_NEAR(three.ratios.at(2).ratio, 2, 1e-9);
    EXPECT_TRUE(three.ratios.at(2).isSlower());
}

}  // namespace

}  // namespace diptych::choose
