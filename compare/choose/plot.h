// SPDX-License-Identifier: MIT
#pragma once

#include "compare/choose/report.h"
#include "compare/plot/drawing.h"

#include <string>

namespace diptych::choose {

// Error over time of all candidates that were judged and timed, as SVG: those timed again with the interval
// of their time, the budget's limits, and the least error that is reached within a time. Both axes are
// logarithmic; an error of 0 and an infinite one have a lane of their own.
std::string choicePlot(const ChoiceReport& report, PlotPlace place);

}  // namespace diptych::choose
