// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"
#include "compare/plot/drawing.h"

#include <string>

namespace diptych::audit {

// Errors of every series over the magnitude, both axes logarithmic. What is below 1e-8, where float32 rounds,
// stands at the foot, infinite errors at the top, and a magnitude of 0 at the left.
std::string auditPlot(const QuantityAudit& audit, PlotPlace place);

}  // namespace diptych::audit
