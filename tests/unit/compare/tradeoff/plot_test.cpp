// SPDX-License-Identifier: MIT
// Labels in plots: none overlaps another, and each belongs to its own point.
#include "compare/tradeoff/plot.h"
#include "compare/plot/error_over_time.h"
#include "compare/plot/labels.h"
#include "compare/tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <regex>

namespace diptych {

using namespace tradeoff;

namespace {

bool meet(const PlotBox& a, const PlotBox& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

TEST(PlotLabels, OfManyPointsAtOnePlaceNoneCoversAnother) {
    const PlotBox area{0, 0, 400, 300};
    for (const auto& [x, y] : {std::pair{200.0, 150.0}, {0.0, 0.0}, {400.0, 300.0}, {400.0, 0.0}}) {
        const std::vector<PlotBox> boxes = placeLabels(std::vector<Label>(8, {x, y, 24, 18}), {}, area);
        ASSERT_EQ(boxes.size(), 8u);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            EXPECT_DOUBLE_EQ(boxes[i].right - boxes[i].left, 24);
            EXPECT_DOUBLE_EQ(boxes[i].bottom - boxes[i].top, 18);
            EXPECT_TRUE(boxes[i].left >= 0 && boxes[i].top >= 0 && boxes[i].right <= 400 &&
                        boxes[i].bottom <= 300)
                << "inside";
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(meet(boxes[i], boxes[j])) << i << " " << j;
        }
    }
}

TEST(PlotLabels, StandsAboveOnTheRightUnlessAMarkIsThere) {
    const PlotBox area{0, 0, 400, 300};
    const PlotBox free = placeLabels({{200, 150, 24, 18}}, {}, area).front();
    EXPECT_GT(free.left, 200);
    EXPECT_LT(free.bottom, 150);
    const PlotBox moved = placeLabels({{200, 150, 24, 18}}, {free}, area).front();
    EXPECT_FALSE(meet(moved, free));
    // With marks everywhere, a label is still placed.
    const PlotBox crowded = placeLabels({{200, 150, 24, 18}}, {area}, area).front();
    EXPECT_TRUE(meet(crowded, area));
}

TradeoffRow timed(const char* path, double ms, double error) {
    TradeoffRow made;
    made.settings.set("path", path);
    made.measured.set(FrameTime{ms, ms, ms, 5});
    made.measured.set(Measure::flip, Errors{error, error, error});
    return made;
}

// Twelve rows on the front within a hundredth of an axis: each has its number, and the numbers do not
// overlap.
TEST(TradeoffPlot, NumbersOfTheFrontStandApart) {
    Tradeoff tradeoff;
    tradeoff.scene = "s";
    for (int i = 0; i < 12; ++i)
        tradeoff.rows.push_back(timed(i % 2 ? "deferred" : "forward_plus", 5 + 0.01 * i, 0.1 - 1e-4 * i));
    tradeoff.rows.push_back(timed("deferred", 1, 0.9));
    tradeoff.rows.push_back(timed("deferred", 90, 1e-4));
    ASSERT_EQ(frontOf(tradeoff, 0).size(), 14u);
    const std::string svg = tradeoffPlot(tradeoff, 0, {}, PlotPlace::page);
    const std::regex label(R"re(<text class="row middle" x="([\d.]+)" y="([\d.]+)">(\d+)</text>)re");
    std::vector<PlotBox> boxes;
    std::vector<int> numbers;
    for (std::sregex_iterator i(svg.begin(), svg.end(), label), end; i != end; ++i) {
        const double x = std::stod((*i)[1]), y = std::stod((*i)[2]);
        const double half = 5.0 * static_cast<double>((*i)[3].length());  // of the largest text
        boxes.push_back({x - half, y - 12, x + half, y});
        numbers.push_back(std::stoi((*i)[3]));
    }
    std::ranges::sort(numbers);
    std::vector<int> all(14);
    std::iota(all.begin(), all.end(), 1);
    EXPECT_EQ(numbers, all);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(meet(boxes[i], boxes[j])) << i << " " << j;
    EXPECT_NE(svg.find("class=\"lead\""), std::string::npos) << "a number that went far is led to";
}

// Scattered rows: a number that is closer to another row's mark gets a line to its own.
TEST(TradeoffPlot, ANumberNearerToAnotherPointIsLedTo) {
    int near = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Tradeoff tradeoff;
        tradeoff.scene = "s";
        unsigned state = seed;
        const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
        for (int i = 0; i < 60; ++i)
            tradeoff.rows.push_back(timed("deferred", std::pow(10.0, 1e-3 * (next() % 1000)),
                                          std::pow(10.0, -1e-3 * (next() % 1000))));
        const std::string svg = tradeoffPlot(tradeoff, 0, {}, PlotPlace::page);
        const std::regex mark(
            R"re(data-row="(\d+)"[^>]*>(?:<path[^>]*>)?<circle class="mark" cx="([\d.]+)" cy="([\d.]+)")re"),
            label(R"re((class="lead"[^>]*>)?<text class="row middle" x="([\d.]+)" )re"
                  R"re(y="([\d.]+)">(\d+)</text>)re");
        std::map<int, std::array<double, 2>> marks;
        for (std::sregex_iterator i(svg.begin(), svg.end(), mark), end; i != end; ++i)
            marks[std::stoi((*i)[1])] = {std::stod((*i)[2]), std::stod((*i)[3])};
        ASSERT_EQ(marks.size(), 60u);
        for (std::sregex_iterator i(svg.begin(), svg.end(), label), end; i != end; ++i) {
            const double x = std::stod((*i)[2]), y = std::stod((*i)[3]) + 3 - 17 / 2.0;  // its centre
            const auto from = [&](const std::array<double, 2>& m) { return std::hypot(x - m[0], y - m[1]); };
            const double own = from(marks.at(std::stoi((*i)[4])));
            const bool other =
                std::ranges::any_of(marks, [&](const auto& m) { return from(m.second) < own - 0.2; });
            near += other && own < 40;
            EXPECT_TRUE(!other || (*i)[1].matched) << "seed " << seed << ", row " << (*i)[4];
        }
    }
    EXPECT_GT(near, 0) << "there are such numbers, not far from their points";
}

TEST(TradeoffPlot, TheErrorIsNamedAboveItsAxis) {
    Tradeoff tradeoff;
    tradeoff.scene = "s";
    tradeoff.rows = {timed("deferred", 1, 0.002), timed("deferred", 2, 0.001)};
    const std::string svg = tradeoffPlot(tradeoff, 0, {}, PlotPlace::page);
    EXPECT_EQ(svg.find("rotate"), std::string::npos);
    const std::regex name(R"re(<text class="name" x="([\d.]+)" y="([\d.]+)">FLIP</text>)re"),
        tick(R"re(<text class="tick end" x="[\d.]+" y="([\d.]+)">)re");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(svg, found, name));
    for (std::sregex_iterator i(svg.begin(), svg.end(), tick), end; i != end; ++i)
        EXPECT_GT(std::stod((*i)[1]), std::stod(found[2]) + 12) << "no tick's label in its line";
}

// A square has about the area of a circle of that radius.
TEST(PlotMarks, ASquareIsForwardPlusAndACircleDeferred) {
    EXPECT_EQ(pathMark(Path::forward_plus, 10, 20, 5),
              "<rect class=\"mark\" x=\"5.5\" y=\"15.5\" width=\"9.0\" height=\"9.0\"/>");
    EXPECT_EQ(pathMark(Path::deferred, 10, 20, 5),
              "<circle class=\"mark\" cx=\"10.0\" cy=\"20.0\" r=\"5.0\"/>");
}

}  // namespace
}  // namespace diptych
