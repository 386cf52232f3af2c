// SPDX-License-Identifier: MIT
#pragma once

#include "compare/choose/report.h"
#include "compare/plot/drawing.h"

#include <string>

namespace diptych::choose {

// SVG of error over time for all judged and timed candidates. Shows time intervals of raced candidates,
// the budget and the Pareto front. Both axes are logarithmic; errors of 0 and infinity get their own
// lanes.
std::string choicePlot(const ChoiceReport& report, PlotPlace place);

}  // namespace diptych::choose
