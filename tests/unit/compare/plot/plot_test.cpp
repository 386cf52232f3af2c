// SPDX-License-Identifier: MIT
// The plot that all commands share: axes, lanes, series, legend, colours; and data that has no place on an
// axis.
#include "compare/plot/plot.h"
#include "compare/page/emitted.h"
#include "compare/plot/axis.h"
#include "compare/plot/labels.h"
#include "tests/support/color_vision.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <regex>
#include <sstream>

namespace diptych {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::nan("");

std::vector<std::string> allOf(const std::string& svg, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator i(svg.begin(), svg.end(), expression), end; i != end; ++i)
        found.push_back((*i)[1]);
    return found;
}

Plot plotOf(const std::vector<PlotPoint>& points) {
    PlotPanel panel{.across = {"time"}, .up = {"error"}};
    panel.pointsOf("deferred", Path::deferred) = points;
    return {.title = "a plot", .panels = {panel}};
}

// Well-formed, of the shape that pages may have, and without a length that is no number.
void expectSound(const Plot& plot) {
    for (const PlotTarget target : {PlotTarget::file, PlotTarget::page}) {
        const std::string svg = svgOf(plot, target);
        EXPECT_EQ(markupFault(svg), "");
        EXPECT_NO_THROW(checkPlot(svg));
        EXPECT_EQ(allOf(svg, "([a-z0-9]+=\"[^\"]*(?:nan|inf)\\b[^\"]*\")"), std::vector<std::string>());
        EXPECT_EQ(svg.find("xmlns=") != svg.npos, target == PlotTarget::file);
    }
}

// ---- Axes ----

struct Named {
    std::vector<double> values, positions;
};
Named namesOf(const Axis& axis) {
    Named named;
    for (const PlotTick& tick : axis.ticks()) {
        if (tick.text.empty() || std::string_view(tick.kind) == "gap") continue;
        named.values.push_back(std::stod(tick.text));
        named.positions.push_back(tick.at);
    }
    return named;
}

TEST(PlotAxis, SomeTicksAreNamedAndNoNamesOverlap) {
    for (const bool logarithmic : {true, false})
        for (const std::vector<double>& values : std::vector<std::vector<double>>{{1e-7, 1},
                                                                                  {3, 4},
                                                                                  {100, 100.5},
                                                                                  {5},
                                                                                  {0.02, 60},
                                                                                  {9, 47},
                                                                                  {},
                                                                                  {0, -1, infinite},
                                                                                  {1e-30, 1e30},
                                                                                  {1e300, 1e-300},
                                                                                  {5e-324},
                                                                                  {1.7e308},
                                                                                  {-1e300, 0, 1e300},
                                                                                  {none}})
            for (const double length : {270.0, 622.0}) {
                const Axis axis({.logarithmic = logarithmic}, values, {}, 0, length, false);
                EXPECT_LT(axis.ticks().size(), 500u);
                const auto [named, positions] = namesOf(axis);
                EXPECT_GE(named.size(), 2u) << testing::PrintToString(values) << logarithmic;
                for (std::size_t i = 0; i < named.size(); ++i) {
                    EXPECT_NEAR(axis.at(named[i]), positions[i], 0.1) << named[i] << " is where it says";
                    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(std::abs(positions[i] - positions[k]), 19);
                }
                for (const double value : values) {
                    EXPECT_GE(axis.at(value), 0);
                    EXPECT_LE(axis.at(value), length);
                }
            }
}

TEST(PlotAxis, ADecadeHasTicksAtOneTwoAndFive) {
    const auto named = [](const std::vector<double>& points) {
        std::vector<double> values = namesOf(Axis({}, points, {}, 0, 600, false)).values;
        std::ranges::sort(values);
        return values;
    };
    EXPECT_EQ(named({1.5, 12}), (std::vector<double>{2, 5, 10}));
    EXPECT_EQ(named({1, 5}), (std::vector<double>{1, 2, 5}));
}

// Even ticks have a step of 1, 2, 5 or 10 times a power of ten: the least of at least a sixth of the axis.
TEST(PlotAxis, ALinearAxisHasAboutSixEvenTicks) {
    for (const auto& [end, step] :
         {std::pair{6.0, 1.0}, {6.1, 2.0}, {12.0, 2.0}, {12.1, 5.0}, {30.0, 5.0}, {31.0, 10.0}}) {
        const std::vector<PlotTick> ticks = Axis({.logarithmic = false}, {end}, {}, 0, 600, false).ticks();
        ASSERT_EQ(ticks.size(), static_cast<std::size_t>(end / step) + 1) << end;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            EXPECT_EQ(ticks[i].text, fmt::format("{:g}", static_cast<double>(i) * step));
            EXPECT_NEAR(ticks[i].at, 600 * static_cast<double>(i) * step / end, 1e-9);
        }
    }
    // A short part of a decade is even too, and has each tick once.
    std::vector<double> positions;
    for (const PlotTick& tick : Axis({}, {3, 4}, {}, 0, 600, false).ticks()) positions.push_back(tick.at);
    EXPECT_TRUE(std::ranges::adjacent_find(positions, std::greater_equal<>()) == positions.end());
}

TEST(PlotAxis, PositionsAreLogarithmicLinearOrEven) {
    const Axis logarithmic({}, {1, 100}, {}, 0, 100, false);
    EXPECT_NEAR(logarithmic.at(10), 50, 1e-9);
    const Axis linear({.logarithmic = false}, {}, {4}, 100, 0, true);
    EXPECT_EQ(linear.at(0), 100) << "from 0";
    EXPECT_EQ(linear.at(1), 75);
    const Axis even({.categories = {"a", "b"}}, {}, {}, 0, 100, false);
    EXPECT_EQ(even.at(0), 25);
    EXPECT_EQ(even.at(1), 75);
    EXPECT_EQ(even.ticks().at(1).text, "b");
}

TEST(PlotAxis, ZeroAndInfiniteValuesHaveLanesBehindALine) {
    const auto lanesOf = [](const std::vector<double>& points, bool logarithmic = true) {
        std::string lanes;
        for (const PlotTick& tick :
             Axis({.logarithmic = logarithmic}, points, {1e-3, 1}, 100, 0, true).ticks())
            if (std::string_view(tick.kind) == "gap") lanes += tick.text + " ";
        return lanes;
    };
    EXPECT_EQ(lanesOf({1e-3, 1}), "");
    EXPECT_EQ(lanesOf({0, 1}), "0 ");
    EXPECT_EQ(lanesOf({1, infinite}), "\u221e ");
    EXPECT_EQ(lanesOf({-1, 1e-3, none}), "0 \u221e/NaN ");
    EXPECT_EQ(lanesOf({0, infinite}, false), "\u221e ") << "a linear axis has 0";
    const Axis axis({}, {0, 1e-3, 1, infinite}, {}, 100, 0, true);
    EXPECT_GT(axis.at(0), axis.at(1e-3) + 10);
    EXPECT_LT(axis.at(infinite), axis.at(1) - 10);
    EXPECT_EQ(axis.at(none), axis.at(infinite));
    for (const PlotTick& tick : axis.ticks())
        if (std::string_view(tick.kind) == "gap") {
            EXPECT_EQ(tick.at, axis.at(tick.text == "0" ? 0 : infinite)) << "named in the middle of its lane";
            EXPECT_NEAR(std::abs(tick.line - (tick.text == "0" ? 100 : 0)), 26, 1e-9);
        }
}

// ---- Data ----

TEST(Plot, AnyDataIsDrawn) {
    expectSound({});
    expectSound({.title = "empty panels", .panels = {{}, {}, {}}, .columns = 2});
    expectSound(plotOf({}));
    for (const double x : {0.0, -1.0, 1.0, 1e308, 5e-324, infinite, -infinite, none})
        for (const double y : {0.0, 1.0, infinite, none})
            expectSound(
                plotOf({{.x = x, .y = y, .across = {x / 2, 2 * x}, .up = {0, infinite}, .label = "a"}}));
    Plot bars{.panels = {{.across = {.logarithmic = false}, .up = {.categories = {"a"}}}}, .parts = {"b"}};
    for (const PlotRange& across : {PlotRange{0, 0}, {0, 1}, {0, infinite}, {none, 1}, {-1e308, 1e308}})
        bars.panels[0].bars.push_back({across, barAt(0), 99, "c"});
    expectSound(bars);
    Plot limits = plotOf({{.x = 1, .y = 1}});
    limits.panels[0].limits = {
        {.x = infinite, .name = "a"}, {.y = 0, .name = "b"}, {.x = none, .y = none, .name = ""}};
    limits.panels[0].front = {{infinite, 0}, {0, infinite}};
    expectSound(limits);
}

TEST(Plot, ForeignTextIsEscapedEverywhere) {
    const std::string hostile = "<b>\"a' & </svg>\x01";
    Plot plot{.title = hostile, .parts = {hostile}, .interval = "i" + hostile, .chooses = true};
    PlotPanel panel{.across = {.name = hostile, .categories = {hostile}}, .up = {.name = hostile}};
    panel.pointsOf("s" + hostile, {}).push_back({.text = hostile, .row = 1, .label = hostile});
    panel.bars = {{{0, 1}, {0, 1}, 0, hostile}};
    panel.limits = {{.x = 1, .name = "l" + hostile}};
    plot.panels = {panel};
    expectSound(plot);
    for (const PlotTarget target : {PlotTarget::file, PlotTarget::page}) {
        const std::string svg = svgOf(plot, target);
        EXPECT_EQ(svg.find("<b>"), svg.npos);
        EXPECT_GE(countOf(svg, "&lt;b&gt;&quot;a&#39; &amp; &lt;/svg&gt;\ufffd"), 10u);
    }
}

TEST(Plot, PointsHaveMarksOfTheirPathAndIntervals) {
    Plot plot = plotOf({{.x = 1, .y = 1, .up = {0.5, 2}, .row = 7}});
    plot.panels[0].pointsOf("forward_plus", Path::forward_plus, false).push_back({.x = 2, .y = 1});
    const std::string page = svgOf(plot, PlotTarget::page), file = svgOf(plot, PlotTarget::file);
    EXPECT_EQ(countOf(page, "<circle class=\"mark\""), 2u) << "round, and in the legend";
    EXPECT_EQ(countOf(page, "<rect class=\"mark\""), 2u) << "square";
    EXPECT_EQ(countOf(page, "class=\"bar\""), 1u) << "equal ends are no interval";
    EXPECT_EQ(countOf(page, "class=\"trace\""), 2u) << "a line, and in the legend";
    EXPECT_EQ(countOf(page, "data-row=\"7\" tabindex=\"0\" role=\"img\""), 1u) << "the other has no row";
    EXPECT_EQ(file.find("tabindex"), file.npos);
    plot.chooses = true;
    EXPECT_EQ(countOf(svgOf(plot, PlotTarget::page), "role=\"button\""), 1u);
}

// A path's series differ in dashes; series of one name are one in all panels.
TEST(Plot, SeriesDifferAndAreNamedOnce) {
    Plot plot{.panels = {{}, {}}};
    for (PlotPanel& panel : plot.panels) {
        panel.pointsOf("first", Path::deferred).push_back({1, 1});
        panel.pointsOf("other", Path::forward_plus).push_back({1, 2});
        panel.pointsOf("second", Path::deferred).push_back({1, 3});
    }
    const std::string svg = svgOf(plot, PlotTarget::page);
    for (const char* classes : {"series deferred v0", "series deferred v1", "series forward_plus v0"})
        EXPECT_EQ(countOf(svg, "\"" + std::string(classes) + "\""), 3u)
            << classes << ": two panels and the legend";
    // The legend has two columns of short names.
    std::vector<std::pair<double, double>> places;
    for (const char* name : {"first", "second", "other"}) {
        const std::string shown = ">" + std::string(name) + "<";
        EXPECT_EQ(countOf(svg, shown), 1u);
        std::istringstream place(svg.substr(svg.rfind("translate(", svg.find(shown)) + 10));
        place >> places.emplace_back().first >> places.back().second;
    }
    std::ranges::sort(places, {}, [](const auto& place) { return std::pair(place.second, place.first); });
    EXPECT_EQ(places[0].second, places[1].second);
    EXPECT_LT(places[0].first, places[1].first);
    EXPECT_EQ(places[2].first, places[0].first);
    EXPECT_GT(places[2].second, places[0].second);
}

TEST(Plot, AFrontIsAStepLineBelowAllItsPoints) {
    Plot plot = plotOf({{.x = 1, .y = 1}, {.x = 10, .y = 0.1}, {.x = 100, .y = 0.01}});
    EXPECT_EQ(svgOf(plot, PlotTarget::page).find("front"), std::string::npos);
    plot.panels[0].front = {{10, 0.1}, {1, 1}};
    const std::string svg = svgOf(plot, PlotTarget::page);
    EXPECT_EQ(allOf(svg, "class=\"front\" d=\"M[0-9. ]+V([0-9.]+)H").size(), 1u) << "sorted, from the left";
    EXPECT_EQ(allOf(svg, "(>Pareto front<)").size(), 1u);
}

// A name above its axis does not collide with ticks, and it is not rotated.
TEST(Plot, AnAxisIsNamedAboveIt) {
    const std::string svg = svgOf(plotOf({{.x = 1, .y = 0.002}, {.x = 2, .y = 0.001}}), PlotTarget::page);
    EXPECT_EQ(svg.find("rotate"), std::string::npos);
    const std::vector<std::string> name =
        allOf(svg, "<text class=\"name\" x=\"[0-9.]+\" y=\"([0-9.]+)\">error<");
    ASSERT_EQ(name.size(), 1u);
    for (const std::string& tick : allOf(svg, "<text class=\"tick end\" x=\"[0-9.]+\" y=\"([0-9.]+)\">"))
        EXPECT_GT(std::stod(tick), std::stod(name[0]) + 12);
}

// ---- Geometry ----

// The boxes of a plot's panels, by the lines of their axes.
std::vector<PlotBox> boxesOf(const std::string& svg) {
    std::vector<PlotBox> boxes;
    for (const std::string& path : allOf(svg, "class=\"axis\" d=\"([^\"]*)\"")) {
        PlotBox& box = boxes.emplace_back();
        EXPECT_EQ(std::sscanf(path.c_str(), "M%lf %lfV%lfH%lf", &box.left, &box.top, &box.bottom, &box.right),
                  4)
            << path;
    }
    return boxes;
}

// On linear axes from 0 to 4, everything has its value's fraction of the panel's box.
TEST(Plot, EverythingIsDrawnAtItsValues) {
    Plot plot{.panels = {{.across = {.logarithmic = false}, .up = {.logarithmic = false}}}, .parts = {"p"}};
    PlotPanel& panel = plot.panels[0];
    panel.pointsOf("deferred", Path::deferred) = {
        {.x = 1, .y = 2, .across = {0.5, 1.5}, .up = {1, 3}}, {.x = 4, .y = 3, .row = 5}, {.x = 2, .y = 4}};
    panel.pointsOf("forward_plus", Path::forward_plus) = {{.x = 3, .y = 2}, {.x = 1, .y = 4, .best = true}};
    panel.pointsOf("reference", Path::reference) = {{.x = 2, .y = 3}};
    panel.pointsOf("other", {}) = {{.x = 4, .y = 4}};
    panel.bars = {{{0, 2}, {0, 1}, 0, "b"}, {{2, 3}, {0, 1}, 0, "c", true}};
    panel.limits = {{.x = 3, .name = "l"}, {.y = 1, .name = "m", .strict = false}};
    panel.front = {{2, 1}, {1, 3}};
    const std::string svg = svgOf(plot, PlotTarget::page);
    const std::vector<PlotBox> boxes = boxesOf(svg);
    ASSERT_EQ(boxes.size(), 1u);
    const PlotBox& box = boxes[0];
    const double width = box.right - box.left, height = box.bottom - box.top;
    const auto x = [&](double value) { return fmt::format("{:.1f}", box.left + value / 4 * width); };
    const auto y = [&](double value) { return fmt::format("{:.1f}", box.bottom - value / 4 * height); };
    const auto lineOf = [&](const char* kind, double x1, double y1, double x2, double y2) {
        return fmt::format("<path class=\"{}\" d=\"M{} {}L{} {}\"/>", kind, x(x1), y(y1), x(x2), y(y2));
    };
    const auto barOf = [&](const char* kind, double from, double to, const char* title) {
        return fmt::format(
            "<rect class=\"part {}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{:.1f}\">"
            "<title>{}</title></rect>",
            kind, box.left + from / 4 * width, y(1), (to - from) / 4 * width, height / 4, title);
    };
    // Half sizes: of a square 0.9 of the radius, 4 or, for the best, 6; of a bar 1 and 3 radii.
    const auto squareOf = [&](double across, double up, double half, double tall) {
        return fmt::format(
            "<rect class=\"mark\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\">",
            box.left + across / 4 * width - half, box.bottom - up / 4 * height - tall, 2 * half, 2 * tall);
    };
    std::string grid;
    for (int i = 0; i <= 4; ++i) grid += fmt::format("M{} {}L{} {}", x(i), y(4), x(i), y(0));
    for (int i = 0; i <= 4; ++i) grid += fmt::format("M{} {}L{} {}", x(0), y(i), x(4), y(i));
    for (const std::string& shown :
         {squareOf(3, 2, 3.6, 3.6), squareOf(1, 4, 5.4, 5.4), squareOf(4, 4, 1, 12),
          fmt::format("<path class=\"mark\" d=\"M{} {:.1f}l4.8 4.8l-4.8 4.8l-4.8 -4.8z\"/>", x(2),
                      box.bottom - 3.0 / 4 * height - 4.8),
          fmt::format("<path class=\"grid\" d=\"{}\"/>", grid), barOf("part0", 0, 2, "b"),
          barOf("past", 2, 3, "c"), lineOf("budget", 3, 4, 3, 0), lineOf("usual", 0, 1, 4, 1),
          lineOf("bar", 0.5, 2, 1.5, 2), lineOf("bar", 1, 1, 1, 3),
          fmt::format("class=\"front\" d=\"M{} {}V{}H{}V{}H{}\"", x(1), y(4), y(3), x(2), y(1), x(4)),
          fmt::format("class=\"trace\" d=\"M{} {}L{} {}L{} {}\"", x(1), y(2), x(4), y(3), x(2), y(4)),
          fmt::format("class=\"mark\" cx=\"{}\" cy=\"{}\"", x(1), y(2)),
          fmt::format("class=\"mark\" cx=\"{}\" cy=\"{}\"", x(4), y(3)),
          fmt::format("class=\"hit\" cx=\"{}\" cy=\"{}\"", x(4), y(3))})
        EXPECT_EQ(countOf(svg, shown), 1u) << shown << "\n" << svg;
    EXPECT_GT(width, 0);
    EXPECT_GT(height, 0);
    EXPECT_GT(svg.find("point best"), svg.rfind("class=\"point\"><title>")) << "the best are on top";
}

TEST(Plot, AnAxisReachesToTheEndsOfIntervalsAndBars) {
    Plot plot{.panels = {{.across = {.logarithmic = false}, .up = {.logarithmic = false}}}};
    plot.panels[0].pointsOf("deferred",
                            Path::deferred) = {{.x = 1, .y = 1, .across = {0.5, 4}, .up = {0.5, 8}}};
    plot.panels[0].bars = {{{0, 16}, {0, 1}, 0, "b"}};
    const std::string svg = svgOf(plot, PlotTarget::page);
    const PlotBox box = boxesOf(svg).at(0);
    EXPECT_EQ(allOf(svg, "class=\"bar\" d=\"M[0-9.]+ [0-9.]+L([0-9.]+) ").at(0),
              fmt::format("{:.1f}", box.left + (box.right - box.left) / 4))
        << "4 of 16";
    EXPECT_EQ(allOf(svg, "class=\"bar\" d=\"M[0-9.]+ [0-9.]+L[0-9.]+ ([0-9.]+)\"").at(1),
              fmt::format("{:.1f}", box.top));
}

// Rows of panels have the plot's height, or the height of their categories. Below them is the legend, whose
// rows have two short names or a long one.
TEST(Plot, PanelsAndLegendFillThePicture) {
    const auto sizeOf = [](const std::string& svg) {
        PlotBox box{};
        EXPECT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"%lf %lf %lf %lf\"", &box.left,
                              &box.top, &box.right, &box.bottom),
                  4);
        return box;
    };
    for (const std::size_t columns : {1u, 2u}) {
        Plot plot{.columns = columns, .height = 300};
        for (std::size_t i = 0; i < 2 * columns; ++i) {
            plot.panels.push_back({.across = {"time"}, .up = {"error"}});
            plot.panels.back().pointsOf("", {}).push_back({1, 1});
        }
        const std::string svg = svgOf(plot, PlotTarget::page);
        const std::vector<PlotBox> boxes = boxesOf(svg);
        ASSERT_EQ(boxes.size(), 2 * columns);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const PlotBox &box = boxes[i], &first = boxes[0];
            EXPECT_EQ(box.top - first.top, i < columns ? 0 : 300);
            EXPECT_EQ(box.bottom - box.top, first.bottom - first.top);
            EXPECT_EQ(box.right - box.left, first.right - first.left);
            if (i % columns == 0) {
                EXPECT_EQ(box.left, first.left);
            } else {
                EXPECT_GT(box.left, boxes[i - 1].right);
            }
        }
        const PlotBox whole = sizeOf(svg);
        EXPECT_GT(boxes[0].left, 0);
        EXPECT_GT(boxes[0].bottom - boxes[0].top, 150);
        EXPECT_LT(boxes.back().right, whole.right);
        EXPECT_GE(whole.bottom, 600);
        EXPECT_LT(whole.bottom, 620) << "no legend";
        const std::vector<std::string> texts =
            allOf(svg, "<text class=\"[^\"]*\" x=\"[0-9.-]+\" y=\"([^\"]+)\"");
        ASSERT_GE(texts.size(), 4 * columns);
        for (const std::string& at : texts) {
            EXPECT_GT(std::stod(at), 12);
            EXPECT_LT(std::stod(at), 600);
        }
        // An entry more is a row more, unless it fits beside the last.
        const auto entries = [&](const std::vector<std::string>& names) {
            Plot with = plot;
            for (const std::string& name : names) with.panels[0].limits.push_back({.x = 1, .name = name});
            const std::string drawn = svgOf(with, PlotTarget::page);
            const std::vector<std::string> rows =
                allOf(drawn, "<g transform=\"translate\\([0-9.]+ ([0-9.]+)\\)\">");
            EXPECT_EQ(rows.size(), names.size());
            for (const std::string& row : rows) {
                EXPECT_GT(std::stod(row), 600);
                EXPECT_LT(std::stod(row), sizeOf(drawn).bottom - 10);
            }
            return sizeOf(drawn).bottom - whole.bottom;
        };
        const double row = entries({"a"});
        EXPECT_GT(row, 18) << "a line of text";
        EXPECT_EQ(entries({"a", "b"}), row);
        EXPECT_EQ(entries({"a", "b", "c"}), 2 * row);
        EXPECT_EQ(entries({"a", "a name that is far too long for half of a row"}), 2 * row);
    }
    Plot bars{.panels = {{.up = {.categories = {"a"}}}, {.up = {.categories = {"a", "b", "c"}}}}};
    const std::vector<PlotBox> boxes = boxesOf(svgOf(bars, PlotTarget::page));
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(boxes[1].bottom - boxes[1].top, 3 * (boxes[0].bottom - boxes[0].top));
    EXPECT_GT(boxes[1].top, boxes[0].bottom);
}

// ---- Colours ----

Rgb8 colorOf(const std::string& text) {
    const unsigned long value = std::stoul(text, nullptr, 16);
    return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
            static_cast<std::uint8_t>(value & 255)};
}
// On a light and a dark ground.
std::vector<Rgb8> colorsOf(const std::string& name) {
    std::vector<Rgb8> colors;
    for (const std::string& text : allOf(plotStyle, name + "[:{ fil]+#([0-9a-f]{6})"))
        colors.push_back(colorOf(text));
    return colors;
}

// Lightness of paths differs by 15 of CIELAB's L* for every reader; WCAG 2.2 asks for a contrast of 3
// (1.4.11).
TEST(PlotColors, PathsDifferInLightnessAndFromTheGround) {
    const auto grounds = colorsOf("--ground");
    ASSERT_EQ(grounds.size(), 2u);
    std::vector<std::vector<Rgb8>> paths;
    for (const auto& [path, name] : enumNames<Path>()) paths.push_back(colorsOf("--" + std::string(name)));
    for (std::size_t theme = 0; theme < 2; ++theme)
        for (std::size_t i = 0; i < paths.size(); ++i) {
            ASSERT_EQ(paths[i].size(), 2u);
            EXPECT_GE(contrastOf(paths[i][theme], grounds[theme]), 3);
            for (const ColorVision& vision : colorVisions) {
                const auto lightness = [&](std::size_t path) { return labOf(paths[path][theme], vision)[0]; };
                if (i == 1) {
                    EXPECT_GT(std::abs(lightness(0) - lightness(1)), 15) << vision.name;
                }
                for (std::size_t k = 0; k < i; ++k)
                    EXPECT_GT(distance(paths[i][theme], paths[k][theme], vision), 40) << vision.name;
            }
        }
}

TEST(PlotColors, PartsOfABarDifferForEveryReader) {
    std::vector<Rgb8> parts;
    for (std::size_t i = 0; i < maxParts; ++i) {
        const std::vector<Rgb8> colors = colorsOf("part" + std::to_string(i));
        ASSERT_EQ(colors.size(), 1u) << i;
        parts.push_back(colors[0]);
    }
    for (const ColorVision& vision : colorVisions)
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) {
                EXPECT_GT(distance(parts[i], parts[k], vision), 15) << vision.name << ": " << k << ", " << i;
                if (k + 1 == i) {
                    EXPECT_GT(
                        std::abs(labOf(parts[i], colorVisions[0])[0] - labOf(parts[k], colorVisions[0])[0]),
                        9);
                }
            }
}

}  // namespace
}  // namespace diptych
