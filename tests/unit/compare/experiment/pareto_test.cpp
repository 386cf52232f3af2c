// SPDX-License-Identifier: MIT
#include "compare/experiment/pareto.h"
#include "tests/support/nonfinite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace diptych::experiment {

namespace {

// By definition, pair by pair.
std::vector<std::size_t> byDefinition(const std::vector<TimeError>& points) {
    const auto finite = [](const TimeError& p) { return std::isfinite(p.time) && std::isfinite(p.error); };
    const auto beats = [&](const TimeError& a, const TimeError& b) {
        return finite(a) && a.time <= b.time && a.error <= b.error && (a.time < b.time || a.error < b.error);
    };
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (finite(points[i]) &&
            std::ranges::none_of(points, [&](const TimeError& p) { return beats(p, points[i]); }))
            front.push_back(i);
    return front;
}

std::vector<std::size_t> sorted(std::vector<std::size_t> numbers) {
    std::ranges::sort(numbers);
    return numbers;
}

TEST(TradeoffPareto, IsTheFrontByDefinition) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 3000; ++trial) {
        // Few values, so that ties in one or both coordinates are common.
        const int values = trial % 3 == 0 ? 4 : trial % 3 == 1 ? 12 : 1000;
        std::uniform_int_distribution<int> value(0, values), count(0, 40), odd(0, 15);
        std::vector<TimeError> points(static_cast<std::size_t>(count(random)));
        for (TimeError& p : points) {
            p = {1.0 * value(random), 1.0 * value(random)};
            if (const int o = odd(random); o < 4) (o % 2 ? p.time : p.error) = o < 2 ? nan : inf;
        }
        const std::vector<std::size_t> front = paretoFront(points);
        ASSERT_EQ(sorted(front), byDefinition(points)) << trial;
        for (std::size_t i = 1; i < front.size(); ++i)
            ASSERT_LE(points[front[i - 1]].time, points[front[i]].time) << "in order of time";
    }
}

TEST(TradeoffPareto, TiesStay) {
    EXPECT_EQ(paretoFront({{1, 2}, {1, 2}, {2, 1}, {2, 2}, {1, 3}}), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(paretoFront({{3, 0}, {1, 0}, {2, 0}}), std::vector<std::size_t>{1})
        << "equal errors: the fastest";
    EXPECT_TRUE(paretoFront({}).empty());
    EXPECT_TRUE(paretoFront({{nan, 1}, {1, inf}}).empty());
}

// If noise cannot tell times apart, the more accurate row is on the front; with equal errors, the faster
// one.
TEST(TradeoffPareto, LuckIsNoPlaceOnTheFront) {
    using Numbers = std::vector<std::size_t>;
    EXPECT_EQ(paretoFront({{10, 1, 0.5}, {10.4, 0.9, 0.5}}), Numbers{1});
    EXPECT_EQ(paretoFront({{10, 1, 0.5}, {10.6, 0.9, 0.5}}), (Numbers{0, 1}));
    EXPECT_EQ(paretoFront({{10, 1, 0.1}, {10.4, 0.9, 0.5}}), Numbers{1}) << "the larger noise of both";
    EXPECT_EQ(paretoFront({{10.4, 1, 0.5}, {10, 1, 0.5}}), Numbers{1}) << "one picture: the faster";
    // Each is within noise of the next. The fastest is not within noise of the most accurate, and stays.
    EXPECT_EQ(paretoFront({{10, 3, 0.5}, {10.4, 2, 0.5}, {10.8, 1, 0.5}}), (Numbers{0, 2}));
}

// Two copies of the same Settings, timed with 10 % noise: one of them is on the front.
TEST(TradeoffPareto, OneOfTwoCopiesStands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(0, 0.1);
    int both = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const double a = 10 * (1 + noise(random)), b = 10 * (1 + noise(random));
        both += paretoFront({{a, 0.5, 1}, {b, 0.5, 1}, {20, 0.1, 1}}).size() != 2;
    }
    EXPECT_EQ(both, 0);
}

}  // namespace
}  // namespace diptych::experiment
