// SPDX-License-Identifier: MIT
// Fits the table of shared/light/ltc.h.
#pragma once

#include "shared/light/fit/lobe.h"

#include <cstddef>
#include <functional>

namespace diptych::ltc {

// Of cell (i, j).
Lobe lobeOf(std::size_t i, std::size_t j, double f0 = 1);

// For both lobes the transform nearest to it by distance(), searched from a neighbour's cell on (four
// numbers, Nelder and Mead), and its error; magnitude and Fresnel. `start` too is given as the cell's
// factors, so neighbours lie near one another.
LtcCell fitCell(std::size_t i, std::size_t j, const LtcCell& start);

// Roughness 1 first, each row of roughness from the normal on to grazing: every cell starts from the one
// before. On all cores, the same table on any number. `progress` is called from any thread with the share
// done.
LtcTable fitTable(const std::function<void(double)>& progress);

}  // namespace diptych::ltc
