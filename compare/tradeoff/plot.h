// SPDX-License-Identifier: MIT
#pragma once

#include "compare/plot/drawing.h"
#include "compare/tradeoff/tradeoff.h"

#include <optional>
#include <string>

namespace diptych::tradeoff {

// Error over time of the rows of one path, or of all, as SVG: a point a row with error bars, the Pareto front
// a step line. Both axes are logarithmic; errors of 0, and infinite ones, have a lane of their own.
std::string tradeoffPlot(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path,
                         PlotPlace place);

// "flip.svg", "flip.deferred.svg"
std::string plotName(std::size_t figure, std::optional<Path> path);

}  // namespace diptych::tradeoff
