// SPDX-License-Identifier: MIT
// What both kinds of plots of a benchmark are made of. Lengths are in the drawing's own units.
#pragma once

#include "compare/bench/bench.h"

#include <string>
#include <utility>

namespace diptych::bench {

inline constexpr double plotWidth = 720, plotLeft = 74, plotRight = 24, plotTitleLeft = 10;

// A part of the drawing and where the next one may begin.
struct Panel {
    std::string markup;
    double end = 0;
};

// Places of a legend's entries, in two columns below a plot: beside it, names would leave the picture on a
// phone, where text is larger in the drawing's units.
class Legend {
public:
    explicit Legend(double top) : top_(top) {}
    // Where the sign of the next entry begins, 24 wide, and its middle.
    std::pair<double, double> next();
    std::string words(const std::string& text) const;  // of that entry
    double end() const;

private:
    double top_;
    int entries_ = 0;
};

// A point of a line, at the drawing's place: paths differ in the shape of points and the dash of lines.
std::string markAt(Path path, double x, double y);

// A bar a row, stacked of the medians of its passes, with a mark at the median of the whole frames and a line
// from their least to their most. Lengths are proportional to time.
Panel barsOf(const Bench& bench, const Size& size, double above);

}  // namespace diptych::bench
