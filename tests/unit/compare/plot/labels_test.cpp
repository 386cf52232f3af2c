// SPDX-License-Identifier: MIT
// Labels in plots: none overlaps another, and each belongs to its own point.
#include "compare/plot/labels.h"
#include "compare/plot/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <regex>

namespace diptych {
namespace {

bool meet(const PlotBox& a, const PlotBox& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

TEST(PlotLabels, OfManyPointsAtOnePlaceNoneCoversAnother) {
    const PlotBox area{0, 0, 400, 300};
    for (const auto& [x, y] : {std::pair{200.0, 150.0}, {0.0, 0.0}, {400.0, 300.0}, {400.0, 0.0}}) {
        const std::vector<PlotBox> boxes = positionLabels(std::vector<Label>(8, {x, y, 24, 18}), {}, area);
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
    const PlotBox free = positionLabels({{200, 150, 24, 18}}, {}, area).front();
    for (const auto& [end, expected] :
         {std::pair{free.left, 207.0}, {free.top, 125.0}, {free.right, 231.0}, {free.bottom, 143.0}})
        EXPECT_DOUBLE_EQ(end, expected) << "7 from the point";
    const PlotBox moved = positionLabels({{200, 150, 24, 18}}, {free}, area).front();
    EXPECT_FALSE(meet(moved, free));
    // With marks everywhere, a label is still placed.
    const PlotBox crowded = positionLabels({{200, 150, 24, 18}}, {area}, area).front();
    EXPECT_TRUE(meet(crowded, area));
}

// Points whose labels are the numbers of their rows.
std::string labelled(const std::vector<std::pair<double, double>>& points, bool all = true) {
    PlotPanel panel;
    const auto isBest = [&](const auto& point) {
        return std::ranges::none_of(points, [&](const auto& other) {
            return other != point && other.first <= point.first && other.second <= point.second;
        });
    };
    for (std::size_t i = 0; i < points.size(); ++i)
        panel.pointsOf("deferred", Path::deferred)
            .push_back({.x = points[i].first,
                        .y = points[i].second,
                        .row = i + 1,
                        .label = all || isBest(points[i]) ? std::to_string(i + 1) : ""});
    return svgOf({.panels = {panel}}, PlotTarget::page);
}

// Twelve points within a hundredth of an axis: each has its number, and the numbers do not overlap.
TEST(PlotLabels, NumbersOfCrowdedPointsStandApart) {
    std::vector<std::pair<double, double>> points{{1, 0.9}, {90, 1e-4}};
    for (int i = 0; i < 12; ++i) points.emplace_back(5 + 0.01 * i, 0.1 - 1e-4 * i);
    const std::string svg = labelled(points);
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

// Scattered points: a number that is closer to another point gets a line to its own.
TEST(PlotLabels, ANumberNearerToAnotherPointIsLedTo) {
    int near = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        unsigned state = seed;
        const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
        std::vector<std::pair<double, double>> points;
        for (int i = 0; i < 60; ++i) {
            const double x = std::pow(10.0, 1e-3 * (next() % 1000));
            points.emplace_back(x, std::pow(10.0, -1e-3 * (next() % 1000)));
        }
        const std::string svg = labelled(points, false);
        const std::regex mark(R"re(data-row="(\d+)"[^>]*>(?:<(?:title|path)[^>]*>)*(?:</title>)?)re"
                              R"re(<circle class="mark" cx="([\d.]+)" cy="([\d.]+)")re"),
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

}  // namespace
}  // namespace diptych
