// SPDX-License-Identifier: MIT
// Confidence intervals against published tables.
#include "compare/experiment/intervals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace diptych::experiment {
namespace {

TEST(Intervals, StudentsQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(studentT(0.05, 1), 12.706, 1e-3);
    EXPECT_NEAR(studentT(0.05, 2), 4.303, 1e-3);
    EXPECT_NEAR(studentT(0.01, 5), 4.032, 1e-3);
    EXPECT_NEAR(studentT(0.05, 10), 2.228, 1e-3);
    EXPECT_NEAR(studentT(0.001, 30), 3.646, 1e-3);
}

// 1, 2, 3: the deviation is 1, t of 2 degrees of freedom 4.303.
TEST(Intervals, OfAMeanAndOfADifference) {
    const auto [mean, half_width] = meanInterval(std::array{1.0, 2.0, 3.0}, 0.05);
    EXPECT_DOUBLE_EQ(mean, 2);
    EXPECT_NEAR(half_width, 4.303 / std::sqrt(3.0), 1e-3);
    EXPECT_EQ(meanInterval(std::array{5.0}, 0.05).mean, 5);
    EXPECT_TRUE(std::isinf(meanInterval(std::array{5.0}, 0.05).half_width));
    const MeanInterval difference =
        meanDifference(std::array{3.0, 5.0, 7.0, 9.0}, std::array{2.0, 3.0, 4.0}, 0.05);
    EXPECT_DOUBLE_EQ(difference.mean, 2);
    EXPECT_NEAR(difference.half_width, 4.303 / std::sqrt(3.0), 1e-3);
}

TEST(PairedRatio, IsTheMedianOfWhatWasTimedTogether) {
    // The machine becomes ten times slower from the third frame on; the ratio stays.
    const TimeRatio ratio = pairedRatio({2, 2, 20, 20, 20, 22}, {1, 1, 10, 10, 10, 10});
    EXPECT_DOUBLE_EQ(ratio.ratio, 2);
    EXPECT_DOUBLE_EQ(ratio.low, 2);
    EXPECT_DOUBLE_EQ(ratio.high, 2.2);
    EXPECT_EQ(ratio.pairs, 6);
    EXPECT_TRUE(ratio.isSure());
}

// Tables of the sign test: the k-th smallest and k-th largest of n values enclose the median with these
// confidences. n = 6, k = 1: 1 - 2 / 64; n = 9, k = 2: 1 - 2 (1 + 9) / 512; n = 20, k = 6: 0.9586. 2^-n
// underflows to 0 in double from 1,075 pairs on.
TEST(PairedRatio, ThousandsOfFramesHaveANarrowInterval) {
    std::vector<double> slower, faster(5000, 1.0);
    for (int i = 0; i < 5000; ++i) slower.push_back(1 + i / 5000.0);
    const TimeRatio ratio = pairedRatio(slower, faster);
    EXPECT_NEAR(ratio.confidence, 0.95, 0.002);
    // Normal approximation: 1.96 sqrt(n) / 2 ranks to both sides of the median.
    EXPECT_NEAR(ratio.high - ratio.low, 1.96 * std::sqrt(5000.0) / 5000, 5e-4);
}

TEST(PairedRatio, TheIntervalIsThatOfTheSignTest) {
    const auto of = [](int n) {
        std::vector<double> slower, faster;
        for (int i = 1; i <= n; ++i) {
            slower.push_back(i + 1);
            faster.push_back(1);
        }
        return pairedRatio(slower, faster);
    };
    EXPECT_NEAR(of(6).confidence, 1 - 2.0 / 64, 1e-12);
    EXPECT_DOUBLE_EQ(of(6).low, 2);
    EXPECT_NEAR(of(9).confidence, 1 - 20.0 / 512, 1e-12);
    EXPECT_DOUBLE_EQ(of(9).low, 3);
    EXPECT_DOUBLE_EQ(of(9).high, 9);
    EXPECT_NEAR(of(20).confidence, 0.9586, 1e-4);
    EXPECT_DOUBLE_EQ(of(20).low, 7);
    EXPECT_NEAR(of(5).confidence, 1 - 2.0 / 32, 1e-12) << "as sure as five can be";
    EXPECT_FALSE(of(3).isSure());
    EXPECT_NEAR(of(1).confidence, 0, 1e-12);
    EXPECT_FALSE(of(0).isSure());
}

}  // namespace
}  // namespace diptych::experiment
