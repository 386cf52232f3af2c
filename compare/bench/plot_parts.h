// SPDX-License-Identifier: MIT
// Parts of both plots of a benchmark. Lengths are in SVG user units.
#pragma once

#include "compare/bench/bench.h"

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
};
// Points joined by a line. `style`: CSS classes besides the path's.
std::string traceOf(Path path, std::string_view style, const std::vector<PlotPoint>& points);
// A line's symbol in a legend, and its name.
std::string legendOf(Legend& legend, Path path, std::string_view style, const std::string& name);

// A marker. Paths differ in the shape of markers and the dashes of lines.
std::string markAt(Path path, double x, double y);

// One bar per row, stacked by the median times of its passes. Marks the median of whole frames and their
// range. Lengths are linear in time.
Panel barsOf(const Bench& bench, const Size& size, double above);

}  // namespace diptych::bench
