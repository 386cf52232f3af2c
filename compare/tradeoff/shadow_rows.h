// SPDX-License-Identifier: MIT
// Rows of a sweep with evaluated sun shadows, and whether others dominate them.
#pragma once

#include "compare/tradeoff/figure_table.h"

namespace diptych::tradeoff {

struct ShadowRow {
    std::size_t row = 0;  // index
    // Dominated: another row has no more error and no more time (or memory), and less of one of them.
    bool dominated_in_time = false, dominated_in_memory = false;
};

// By ascending error. Empty if the reference traced no shadow-casting sun, or if all rows have equal
// shadows.
std::vector<ShadowRow> shadowRowsOf(const Tradeoff& tradeoff);

FigureTable shadowTable(const Tradeoff& tradeoff);

}  // namespace diptych::tradeoff
