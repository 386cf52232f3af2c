// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"
#include "compare/plot/drawing.h"

#include <string>

namespace diptych::audit {

// Errors of every series over the magnitude, both axes logarithmic. Errors below 1e-8, where float32
// rounds, are at the bottom; infinite errors at the top; magnitude 0 at the left.
std::string auditPlot(const QuantityAudit& audit, PlotPlace place);

}  // namespace diptych::audit
