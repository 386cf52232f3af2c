// SPDX-License-Identifier: MIT
#pragma once

#include "compare/plot/plot.h"
#include "compare/tradeoff/tradeoff.h"

#include <optional>
#include <string>

namespace diptych::tradeoff {

// SVG of error over time for the rows of one path, or all. Shows a point per row with error bars, and the
// Pareto front as a step line. Both axes are logarithmic; errors of 0 and infinity get their own lanes.
std::string tradeoffPlot(const Tradeoff& tradeoff, std::size_t metric, std::optional<Path> path,
                         PlotTarget target);

// "flip.svg", "flip.deferred.svg".
std::string plotName(std::size_t metric, std::optional<Path> path);

}  // namespace diptych::tradeoff
