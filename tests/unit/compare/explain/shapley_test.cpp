// SPDX-License-Identifier: MIT
// Shares of causes, compared with games whose shares have a closed form.
#include "compare/explain/shapley.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace diptych::tests {
namespace {

double sumOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// A game without structure: a random number for each subset.
std::vector<double> randomGame(int causes, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> values(std::size_t{1} << causes);
    for (double& value : values) value = std::uniform_real_distribution(-1.0, 1.0)(random);
    return values;
}

// Shapley's definition: a cause's marginal contribution, averaged over all orders.
std::vector<double> overAllOrders(int causes, const SubsetValue& value) {
    std::vector<int> order(static_cast<std::size_t>(causes));
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> share(order.size());
    double orders = 0;
    do {
        Subset swapped = 0;
        for (const int i : order) {
            const Subset more = swapped | Subset{1} << i;
            share[static_cast<std::size_t>(i)] += value(more) - value(swapped);
            swapped = more;
        }
        ++orders;
    } while (std::next_permutation(order.begin(), order.end()));
    for (double& s : share) s /= orders;
    return share;
}

TEST(Shapley, IsTheMeanOverAllOrders) {
    for (int causes = 0; causes <= 6; ++causes) {
        const std::vector<double> game = randomGame(causes, 7);
        const SubsetValue value = [&](Subset s) { return game.at(s); };
        const Shares exact = exactShares(causes, value);
        const std::vector<double> defined = overAllOrders(causes, value);
        ASSERT_EQ(exact.share.size(), defined.size());
        for (std::size_t i = 0; i < defined.size(); ++i) EXPECT_NEAR(exact.share[i], defined[i], 1e-14);
    }
}

// The shares add up to the value of swapping all causes.
TEST(Shapley, SharesAddUp) {
    for (int causes = 1; causes <= maxExactCauses; ++causes) {
        const std::vector<double> game = randomGame(causes, 11);
        const Shares shares = exactShares(causes, [&](Subset s) { return game.at(s); });
        EXPECT_NEAR(sumOf(shares.share), game.back() - game.front(), 1e-12);
        EXPECT_EQ(shares.all, game.back() - game.front());
    }
    EXPECT_THROW(exactShares(9, [](Subset) { return 0.0; }), std::invalid_argument);
}

TEST(Shapley, IndependentCausesGetWhatTheyBring) {
    const Shares shares = exactShares(
        3, [](Subset s) { return 5.0 * ((s & 1) != 0) + 2.0 * ((s & 2) != 0) - 1.0 * ((s & 4) != 0); });
    EXPECT_NEAR(shares.share[0], 5, 1e-14);
    EXPECT_NEAR(shares.share[1], 2, 1e-14);
    EXPECT_NEAR(shares.share[2], -1, 1e-14);
    for (const double pair : shares.interaction) EXPECT_NEAR(pair, 0, 1e-14);
}

// Each cause alone makes the whole difference. Leaving one out changes nothing, yet both get a share.
TEST(Shapley, RedundantCausesShare) {
    const Shares shares = exactShares(2, [](Subset s) { return s != 0 ? 1.0 : 0.0; });
    EXPECT_EQ(shares.last[0], 0);
    EXPECT_EQ(shares.last[1], 0);
    EXPECT_NEAR(shares.share[0], 0.5, 1e-15);
    EXPECT_NEAR(shares.share[1], 0.5, 1e-15);
    EXPECT_NEAR(shares.interaction[0], -1, 1e-15);
}

// Neither cause has an effect without the other.
TEST(Shapley, CausesThatHideEachOtherShare) {
    const Shares shares = exactShares(2, [](Subset s) { return s == 3 ? 1.0 : 0.0; });
    EXPECT_EQ(shares.alone[0], 0);
    EXPECT_NEAR(shares.share[0], 0.5, 1e-15);
    EXPECT_NEAR(shares.share[1], 0.5, 1e-15);
    EXPECT_NEAR(shares.interaction[0], 1, 1e-15);
}

// Pair (i, j) has index i + j (j - 1) / 2.
TEST(Shapley, PairsHaveTheirPlaces) {
    const int causes = 5;
    for (int j = 1; j < causes; ++j)
        for (int i = 0; i < j; ++i) {
            const Subset both = Subset{1} << i | Subset{1} << j;
            const Shares shares =
                exactShares(causes, [&](Subset s) { return (s & both) == both ? 1.0 : 0.0; });
            for (std::size_t k = 0; k < shares.interaction.size(); ++k)
                EXPECT_NEAR(shares.interaction[k], k == static_cast<std::size_t>(i + j * (j - 1) / 2) ? 1 : 0,
                            1e-14);
        }
}

// The linear form gives the same shares, exact or sampled.
TEST(Shapley, WeightsGiveTheSameShares) {
    for (const int causes : {1, 4, 7}) {
        const std::vector<double> game = randomGame(causes, 13);
        const SubsetValue value = [&](Subset s) { return game.at(s); };
        const auto weighted = [&](const std::vector<SubsetWeights>& weights) {
            std::vector<double> sum(static_cast<std::size_t>(causes));
            for (const SubsetWeights& one : weights)
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one.weight[i] * value(one.subset);
            return sum;
        };
        const std::vector<double> exact = weighted(exactWeights(causes)),
                                  sampled = weighted(sampledWeights(causes, 6, 2));
        const Shares a = exactShares(causes, value), b = sampledShares(causes, value, 6, 2);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            EXPECT_NEAR(exact[i], a.share[i], 1e-12);
            EXPECT_NEAR(sampled[i], b.share[i], 1e-12);
        }
    }
}

// Sampled shares also add up. Their 95 % intervals must contain the true values in at least 90 % of 240
// cases (12 causes, 20 seeds); the standard deviation is 1.4 %.
TEST(Shapley, SampledSharesLieWithinTheirIntervals) {
    const int causes = 12;
    // True share: the cause's own value and half of each of its pairs' values.
    const std::vector<double> own = randomGame(4, 3), pairs = randomGame(8, 5);
    const SubsetValue value = [&](Subset s) {
        double sum = 0;
        for (int i = 0; i < causes; ++i) {
            if ((s >> i & 1) == 0) continue;
            sum += own.at(static_cast<std::size_t>(i));
            for (int j = 0; j < i; ++j)
                if ((s >> j & 1) != 0) sum += pairs.at(static_cast<std::size_t>(i * 12 + j));
        }
        return sum;
    };
    int inside = 0, cases = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Shares shares = sampledShares(causes, value, 40, seed);
        EXPECT_NEAR(sumOf(shares.share), shares.all, 1e-12);
        for (int i = 0; i < causes; ++i) {
            double expected = own.at(static_cast<std::size_t>(i));
            for (int j = 0; j < causes; ++j)
                if (j != i)
                    expected +=
                        0.5 * pairs.at(static_cast<std::size_t>(std::max(i, j) * 12 + std::min(i, j)));
            const auto at = static_cast<std::size_t>(i);
            ++cases;
            // An order and its reverse give pair shares exactly, so there is no deviation.
            inside += std::abs(shares.share[at] - expected) <= shares.interval[at] + 1e-12;
        }
    }
    EXPECT_EQ(inside, cases);
    // Products of three causes do deviate.
    const SubsetValue triples = [&](Subset s) {
        double sum = 0;
        for (int i = 0; i + 2 < causes; ++i)
            sum += (s >> i & 7) == 7 ? own.at(static_cast<std::size_t>(i)) : 0.0;
        return sum;
    };
    inside = cases = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Shares shares = sampledShares(causes, triples, 60, seed);
        for (int i = 0; i < causes; ++i) {
            double expected = 0;
            for (int first = i - 2; first <= i; ++first)
                if (first >= 0 && first + 2 < causes) expected += own.at(static_cast<std::size_t>(first)) / 3;
            const auto at = static_cast<std::size_t>(i);
            ++cases;
            inside += std::abs(shares.share[at] - expected) <= shares.interval[at];
            EXPECT_GT(shares.interval[at], 0);
        }
    }
    EXPECT_GE(inside, 0.9 * cases);
    EXPECT_THROW(sampledShares(3, triples, 5, 0), std::invalid_argument);
}

}  // namespace
}  // namespace diptych::tests
