// SPDX-License-Identifier: MIT
// Ranks and weighted quantiles, compared with sorting.
#include "compare/metrics/order.h"
#include "tests/support/nonfinite.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace diptych {

using namespace metrics;

namespace {

// Spread over many powers of 2; a third of them take one of a few values.
std::vector<float> mixed(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> stops(-140, 120);
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = i % 3 == 0 ? static_cast<float>(i % 7) : std::exp2(stops(random));
    return values;
}

TEST(Order, RanksAreThoseOfTheSortedValues) {
    const std::vector<float> values = mixed(10007);
    std::vector<float> sorted = values;
    std::ranges::sort(sorted);
    const Order order(values);
    EXPECT_EQ(order.size(), values.size());
    for (const double fraction : {0.0, 1e-9, 0.001, 0.25, 0.5, 0.75, 0.99, 0.999, 1.0}) {
        const auto rank = std::max(1.0, std::ceil(fraction * 10007));
        EXPECT_EQ(order.nearestRank(fraction), sorted[static_cast<std::size_t>(rank) - 1]) << fraction;
    }
}

TEST(Order, WhatIsNotThereDoesNotCount) {
    const std::vector<float> values{nan, 3, -1, 0, inf, -0.0f, -inf, 1, -nan};
    const Order order(values);
    EXPECT_EQ(order.size(), 5u) << "3, 0, infinity, 1, and -0, which is 0";
    EXPECT_EQ(order.nearestRank(0), 0);
    EXPECT_EQ(order.nearestRank(0.75), 3);
    EXPECT_EQ(order.nearestRank(1), inf);
    const Order none(std::span<const float>{});
    EXPECT_EQ(none.size(), 0u);
    EXPECT_EQ(none.nearestRank(0.5), 0);
    EXPECT_EQ(none.weightedQuantile(0.5), 0);
    EXPECT_EQ(none.mean(), 0);
}

TEST(Order, WeightedQuantilesByHand) {
    // Total 16; cumulative sums 1, 2, 4, 8, 16.
    const std::vector<float> values{2, 8, 1, 0, 4, 1};
    const Order order(values);
    EXPECT_EQ(order.sum(), 16);
    EXPECT_EQ(order.weightedQuantile(0.01), 1);
    EXPECT_EQ(order.weightedQuantile(0.125), 1) << "both ones are an eighth";
    EXPECT_EQ(order.weightedQuantile(0.25), 2);
    EXPECT_EQ(order.weightedQuantile(0.5), 4);
    EXPECT_EQ(order.weightedQuantile(0.51), 8);
    EXPECT_EQ(order.weightedQuantile(1), 8);
    const std::vector<float> zeros(5, 0.0f);
    EXPECT_EQ(Order(zeros).weightedQuantile(0.5), 0);
}

TEST(Order, WeightedQuantilesAreThoseOfTheSortedValues) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> value(0, 1);
    std::vector<float> values(20011);
    for (float& v : values) v = value(random);
    std::vector<float> sorted = values;
    std::ranges::sort(sorted);
    double sum = 0;
    for (const float v : sorted) sum += double{v};
    const Order order(values);
    for (const double fraction : {0.1, 0.25, 0.5, 0.75, 0.9}) {
        double below = 0;
        std::size_t i = 0;
        while (below + double{sorted[i]} < fraction * sum) below += double{sorted[i++]};
        EXPECT_EQ(order.weightedQuantile(fraction), sorted[i]) << fraction;
    }
}

TEST(Order, ThreadsDoNotChangeTheSum) {
    const std::vector<float> values = mixed(300007);
    const Order many(values);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(Order(values).sum(), many.sum());
}

// Several parts, and values that come in pieces.
TEST(Order, RanksAndQuantilesDoNotDependOnParts) {
    const std::vector<float> values = mixed(300007);
    std::vector<float> sorted = values;
    std::ranges::sort(sorted);
    const Order order(values.size(), [&](std::size_t from, std::size_t to, const Order::Use& use) {
        for (; from < to; from += 1000)
            use(std::span(values).subspan(from, std::min<std::size_t>(1000, to - from)));
    });
    EXPECT_EQ(order.size(), values.size());
    const std::vector<double> fractions{0.75, 0.0, 0.7499, 1.0, 0.5, 0.75};
    const std::vector<float> ranks = order.nearestRanks(fractions);
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        const auto rank = std::max(1.0, std::ceil(fractions[i] * 300007));
        EXPECT_EQ(ranks[i], sorted[static_cast<std::size_t>(rank) - 1]) << fractions[i];
    }
    EXPECT_EQ(order.weightedQuantile(1), sorted.back());
    double sum = 0, below = 0;
    for (const float v : sorted) sum += double{v};
    EXPECT_NEAR(order.sum() / sum, 1, 1e-12);
    EXPECT_NEAR(order.mean() * 300007 / sum, 1, 1e-12);
    std::size_t i = 0;
    while (below + double{sorted[i]} < 0.3 * sum) below += double{sorted[i++]};
    EXPECT_EQ(order.weightedQuantile(0.3), sorted[i]);
    EXPECT_TRUE(order.nearestRanks({}).empty());
    EXPECT_EQ(Order(std::span<const float>{}).nearestRanks(fractions), std::vector<float>(6, 0.0f));
}

}  // namespace
}  // namespace diptych
