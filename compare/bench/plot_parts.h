// SPDX-License-Identifier: MIT
// Parts of both plots of a benchmark. Lengths are in SVG user units.
#pragma once

#include "compare/bench/bench.h"
#include "compare/plot/drawing.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::bench {

inline constexpr double plotWidth = 720, plotLeft = 74, plotRight = 24, plotTitleLeft = 10;

// SVG of a panel, and the y at which the next one may begin.
struct Panel {
    std::string markup;
    double end = 0;
};

// Layout of a legend: two columns below the plot. Beside it, names would not fit on a phone, where text is
// larger in user units.
class Legend {
public:
    explicit Legend(double top) : top_(top) {}
    // Left end of the next entry's symbol, 24 wide, and its vertical centre.
    std::pair<double, double> next();
    std::string words(const std::string& text) const;  // text of the latest entry
    double end() const;

private:
    double top_;
    int entries_ = 0;
};

struct PlotPoint {
    double x, y;
    std::string title;
    double low = 0, high = 0;  // ends of a bar, up; equal: none
};
// Points joined by a line. Paths differ in the shape of markers and the dashes of lines.
struct PlotLine {
    Path path;
    std::string style;  // CSS classes besides the path's
    std::string name;   // in the legend
    std::vector<PlotPoint> points;
};

// Lines over logarithmic axes. `places`: x has these ticks at even distances instead, from 0.
struct LinePanel {
    std::string title, across, up;  // titles of the panel and its axes
    std::vector<PlotLine> lines;
    std::vector<std::string> places{};
};
std::string panelOf(const LinePanel& panel, const PlotBox& box, double title_left);
// A line's symbol in a legend, and its name.
std::string legendOf(Legend& legend, const PlotLine& line);

// The n-th of small panels, two side by side.
PlotBox smallBox(std::size_t n);
double belowSmall(std::size_t panels);  // where the legend of that many may begin

// One bar per row, stacked by the median times of its passes. Marks the median of whole frames and their
// range. Lengths are linear in time.
Panel barsOf(const Bench& bench, const Size& size, double above);

}  // namespace diptych::bench
