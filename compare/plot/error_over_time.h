// SPDX-License-Identifier: MIT
// Shared part of plots of error over frame time. Both axes are logarithmic; errors of 0 and infinite ones
// have their own lanes at the bottom and the top.
#pragma once

#include "compare/plot/drawing.h"
#include "shared/frame/settings.h"

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

}  // namespace diptych
