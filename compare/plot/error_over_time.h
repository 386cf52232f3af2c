// SPDX-License-Identifier: MIT
// Plots of error over frame time. Both axes are logarithmic; errors of 0 and infinite ones have their own
// lanes at the bottom and the top.
#pragma once

#include "compare/plot/drawing.h"
#include "shared/frame/settings.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

class ErrorOverTime {
public:
    // `box`: area inside the axes. `times` (ms) and `errors`: the values to be visible. `points`: errors
    // of the points, which decide whether there are lanes.
    ErrorOverTime(const PlotBox& box, const std::vector<double>& times, const std::vector<double>& errors,
                  std::span<const double> points);

    double x(double ms) const;
    double y(double error) const;
    std::string axes(const std::string& error_name) const;
    // The smallest error reached within a time, as a step line. `points` are (ms, error) with ascending
    // times and descending errors. Empty without points.
    std::string front(std::span<const std::pair<double, double>> points) const;

private:
    const PlotBox box_;
    const LogAxis time_, error_;
    const bool zeros_, infinities_;
};

// A path's point: round or square, so that paths differ in more than colour. `r`: radius.
std::string pathMark(Path path, double x, double y, double r);

// One Settings. A bar spans the least to the greatest time or error, if they differ from the value.
struct ErrorPoint {
    Path path;
    double ms, least_ms, most_ms;
    double error, least_error, most_error;
    std::size_t number;      // data-row
    std::string words;       // tooltip
    bool front = false;      // on the Pareto front
    bool best = false;       // drawn larger, on top
    std::string label = {};  // beside it
};

struct ErrorPlot {
    std::string title, error_name;
    std::vector<ErrorPoint> points{};
    std::optional<double> most_ms{}, most_error{};  // limits
    std::string bar{};                              // what it means; empty: not in the legend
    bool legend = true;
};

// SVG. `role` of a point on a page: "button" or "img".
std::string errorPlot(const ErrorPlot& plot, PlotPlace place, const char* role);

}  // namespace diptych
