// SPDX-License-Identifier: MIT
// Fits the table of shared/light/ltc.h.
#pragma once

#include "shared/light/fit/lobe.h"

#include <cstddef>
#include <functional>

namespace diptych::ltc {

// Lobe of cell (i, j).
Lobe lobeOf(std::size_t i, std::size_t j, double f0 = 1);

// For both lobes, the nearest transform by distance() and its error, and magnitude and Fresnel.
// Nelder-Mead searches four parameters, starting at a neighbour's cell. `start` is relative as in LtcCell,
// so neighbours have similar values.
LtcCell fitCell(std::size_t i, std::size_t j, const LtcCell& start);

// Fits roughness 1 first, and for each roughness from normal to grazing incidence. Every cell starts from
// the previous one. Uses all cores; the result does not depend on their number. `progress` is called from
// any thread with the completed fraction.
LtcTable fitTable(const std::function<void(double)>& progress);

}  // namespace diptych::ltc
