// SPDX-License-Identifier: MIT
// Break points of growth and their text, with made-up times.
#include "compare/bench/findings.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

// A step from 1 to 4 that doubles the amount has the exponent 1/2, which counts; growth of equal size later
// does not replace the first.
TEST(BenchGrowth, BeginsAtTheSquareRoot) {
    EXPECT_TRUE(bendOf({1, 4}, {1, 2}).found);
    EXPECT_FALSE(bendOf({1, 4}, {1, 1.99}).found);
    EXPECT_FALSE(bendOf({1, 4}, {2, 1}).found) << "it shrinks";
    const Bend first = bendOf({1, 4, 16, 64}, {1, 4, 4, 16});
    EXPECT_EQ(first.value, 1);
    EXPECT_EQ(first.until, 4);
    const Bend later = bendOf({1, 4, 16, 64}, {1, 4, 4, 32});
    EXPECT_EQ(later.value, 16);
    EXPECT_EQ(later.until, 64);
    EXPECT_DOUBLE_EQ(later.exponent, 1.5);
    EXPECT_FALSE(Bend().found);
}

BenchRow grownRow(Path path, GrowthAxis axis, double value, double ms, std::vector<PassTime> passes) {
    BenchRow row;
    row.scene = "builtin:array";
    row.settings.path = path;
    row.settings.size = {64, 48};
    row.growth = GrowthPoint{axis, value};
    row.measured[Measure::lights] = 1;
    row.measured.set(FrameTime{ms, ms / 2, 2 * ms, 5});
    row.measured.set(FrameBytes{1 << 20, 1 << 19});
    row.passes = std::move(passes);
    return row;
}

// By axis, then in row order; within a line by value.
Bench grownOnTwoAxes() {
    Bench bench;
    bench.scene = "growth";
    bench.options.table = BenchTable::growth;
    bench.rows = {grownRow(Path::deferred, GrowthAxis::textures, 4, 8, {{"shade", 8}}),
                  grownRow(Path::deferred, GrowthAxis::textures, 16, 6, {{"shade", 5}}),
                  grownRow(Path::forward_plus, GrowthAxis::triangles, 1e6, 12,
                           {{"cull", 3}, {"depth", 1}, {"shade", 8}}),
                  grownRow(Path::forward_plus, GrowthAxis::triangles, 1e4, 3, {{"depth", 2}, {"shade", 1}}),
                  grownRow(Path::forward_plus, GrowthAxis::triangles, 1e5, 10, {{"depth", 1}, {"shade", 7}}),
                  grownRow(Path::deferred, GrowthAxis::triangles, 1e4, 3, {{"shade", 3}})};
    return bench;
}

// Passes may be new (cull), and may shrink (depth): 3 of 10 added ms, and 7 in shade.
TEST(BenchGrowth, TerminalAndJsonHaveEveryLine) {
    const Bench bench = grownOnTwoAxes();
    const std::string time =
        "forward_plus, time over triangles: 3 ms at 10000, 12 ms at 1e+06; grows with exponent 0.52 up to "
        "1e+05; 70 % of the added time is in shade";
    const std::string memory = "memory over triangles: 1.5 MiB at 10000, 1.5 MiB at 1e+06; flat";
    EXPECT_EQ(benchEnd(bench), "How time and memory grow\n  " + time + "\n  forward_plus, " + memory +
                                   "\n  deferred, time over textures: 8 ms at 4, 6 ms at 16; flat\n"
                                   "  deferred, memory over textures: 1.5 MiB at 4, 1.5 MiB at 16; flat\n");
    EXPECT_NE(
        benchHtml(bench).find("<h2>How time and memory grow</h2>\n<div class=\"box says\"><ul><li>" + time),
        std::string::npos);
    Bench one = bench;
    one.rows.erase(one.rows.begin(), one.rows.end() - 1);
    EXPECT_EQ(benchEnd(one), "") << "no line, no heading";
    EXPECT_EQ(
        benchTable(one, 0),
        "  lights       size  amount              path          assign              ms       min       "
        "max     memory  passes, ms\n"
        "       1      64x48  10000 triangles     deferred      clustered            3       1.5         "
        "6    1.5 MiB  shade 3\n");
    const nlohmann::ordered_json growth = benchJson(bench)["growth"];
    EXPECT_EQ(growth["words"].size(), 4u);
    EXPECT_EQ(growth["words"][0], time);
    EXPECT_EQ(growth["words"][1], "forward_plus, " + memory);
    EXPECT_EQ(growth["lines"].dump(),
              R"([{"axis":"triangles","unit":"triangles","path":"forward_plus","points":[)"
              R"({"value":10000.0,"ms":{"median":3.0,"min":1.5,"max":6.0},"mib":1.5},)"
              R"({"value":100000.0,"ms":{"median":10.0,"min":5.0,"max":20.0},"mib":1.5},)"
              R"({"value":1000000.0,"ms":{"median":12.0,"min":6.0,"max":24.0},"mib":1.5}]},)"
              R"({"axis":"triangles","unit":"triangles","path":"deferred","points":[)"
              R"({"value":10000.0,"ms":{"median":3.0,"min":1.5,"max":6.0},"mib":1.5}]},)"
              R"({"axis":"textures","unit":"MiB of textures","path":"deferred","points":[)"
              R"({"value":4.0,"ms":{"median":8.0,"min":4.0,"max":16.0},"mib":1.5},)"
              R"({"value":16.0,"ms":{"median":6.0,"min":3.0,"max":12.0},"mib":1.5}]}])");
    EXPECT_TRUE(conclusionsOf(bench).empty());
}

// Growth from below 100 000 on: all digits; above, four.
TEST(BenchGrowth, LargeNumbersAreShort) {
    Bench bench;
    bench.options.table = BenchTable::growth;
    bench.rows = {grownRow(Path::deferred, GrowthAxis::pixels, 99999, 4, {}),
                  grownRow(Path::deferred, GrowthAxis::pixels, 100000, 4, {}),
                  grownRow(Path::deferred, GrowthAxis::pixels, 1234567, 49.384, {})};
    EXPECT_EQ(
        growthText(bench)[0],
        "deferred, time over pixels: 4 ms at 99999, 49.38 ms at 1.235e+06; flat up to 1e+05, then grows "
        "with exponent 1.00");
}

}  // namespace
}  // namespace diptych
