// SPDX-License-Identifier: MIT
// Maps values to positions, and names some of them. Lengths are in the drawing's own units.
#pragma once

#include "compare/plot/plot_axis.h"

#include <string>
#include <vector>

namespace diptych {

constexpr double plotLetter = 11.5;  // width of a letter at the style's largest text size

struct PlotTick {
    double at;         // of its text
    std::string text;  // empty: a minor tick
    const char* kind;  // of its line, a class of plot.css
    double line;       // its position
};

class Axis {
public:
    // From `begin` to `end`; upwards, or else across. `points`: values that decide whether there are lanes.
    // `others`: further values that must be visible.
    Axis(const PlotAxis& axis, const std::vector<double>& points, const std::vector<double>& others,
         double begin, double end, bool up);

    // The nearest end for values that the axis does not show.
    double at(double value) const;
    // Powers of ten; if few are visible, multiples of them; over less than a decade, even steps. Then lanes.
    // A name that would overlap another is omitted.
    std::vector<PlotTick> ticks() const;

private:
    void add(std::vector<PlotTick>& ticks, double value, const std::string& text) const;
    void addEven(std::vector<PlotTick>& ticks) const;
    void addDecades(std::vector<PlotTick>& ticks) const;

    const std::vector<std::string> categories_;
    const bool logarithmic_, up_;
    bool zeros_ = false, infinities_ = false, nans_ = false;  // NaN: with infinities
    const double begin_, end_;
    double first_, last_;          // without lanes
    double low_ = 0.1, high_ = 1;  // the values there
};

}  // namespace diptych
