// SPDX-License-Identifier: MIT
// Break points of growth and their text, with made-up times.
#include "compare/bench/findings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace diptych {

using namespace bench;

namespace {

Bench grownBench(const std::vector<std::pair<double, double>>& msAt) {
    Bench bench;
    bench.options.table = BenchTable::growth;
    for (const auto& [value, ms] : msAt) {
        BenchRow row;
        row.settings.path = Path::deferred;
        row.growth = GrowthPoint{GrowthAxis::draws, value};
        row.measured.set(FrameTime{ms, ms, ms, 1});
        row.measured.set(FrameBytes{3 << 20, 1 << 20});
        row.passes = {{"G-buffer", ms - 2}, {"shade", 2}};
        bench.rows.push_back(row);
    }
    return bench;
}

TEST(BenchGrowth, BendsWhereItBeginsToGrow) {
    const Bend linear = bendOf({1, 10, 100, 1000}, {5, 5.5, 10, 100});
    EXPECT_TRUE(linear.found);
    EXPECT_EQ(linear.value, 100);
    EXPECT_NEAR(linear.exponent, 1, 1e-12);
    const Bend all = bendOf({2, 4, 8}, {1, 4, 16});
    EXPECT_EQ(all.value, 2);
    EXPECT_NEAR(all.exponent, 2, 1e-12);
    EXPECT_FALSE(bendOf({1, 10, 100}, {5, 6, 7}).found);
    const Bend early = bendOf({1, 10, 100, 1000, 10000}, {5, 50, 60, 70, 300});
    EXPECT_EQ(early.value, 1) << "tenfold is more than five times";
    EXPECT_EQ(early.until, 10);
    EXPECT_NEAR(early.exponent, 1, 1e-12);
    EXPECT_FALSE(bendOf({1}, {5}).found);
    EXPECT_FALSE(bendOf({}, {}).found);
    EXPECT_THROW(bendOf({1, 2}, {1}), std::logic_error);
}

TEST(BenchGrowth, SaysWhereAndWhy) {
    const Bench bench = grownBench({{1000, 50}, {10, 5}, {100, 6}});
    const std::vector<GrowthLine> lines = growthLines(bench);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].rows[0]->growth->value, 10);
    EXPECT_EQ(memoryMib(*lines[0].rows[0]), 4);
    const std::vector<std::string> words = growthText(bench);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0],
              "deferred, time over draws: 5 ms at 10, 50 ms at 1000; flat up to 100, then grows with "
              "exponent 0.92; 100 % of the added time is in G-buffer");
    EXPECT_EQ(words[1], "deferred, memory over draws: 4 MiB at 10, 4 MiB at 1000; flat");
    EXPECT_TRUE(growthText(grownBench({{10, 5}})).empty()) << "one point grows nowhere";
}

}  // namespace
}  // namespace diptych
