// SPDX-License-Identifier: MIT
// What plots of errors over frame times share. Both axes are logarithmic; errors of 0 and infinite ones stand
// in lanes of their own at the foot and at the top.
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
    // `box`: what the axes enclose. `times` (ms) and `errors`: all that has to be in view. `points`: the
    // errors of the points alone, by which it is decided whether there are lanes.
    ErrorOverTime(const PlotBox& box, const std::vector<double>& times, const std::vector<double>& errors,
                  std::span<const double> points);

    double x(double ms) const;
    double y(double error) const;
    std::string axes(const std::string& error_name) const;
    // The least error that is reached within a time, by points (ms, error) with ascending times and
    // descending errors: a step line, lower only from the next point on. Empty without points.
    std::string front(std::span<const std::pair<double, double>> points) const;

private:
    const PlotBox box_;
    const LogAxis time_, error_;
    const bool zeros_, infinities_;
};

// A point of a path: round or square, so that paths differ not by colour alone. `r`: its radius.
std::string pathMark(Path path, double x, double y, double r);

}  // namespace diptych
