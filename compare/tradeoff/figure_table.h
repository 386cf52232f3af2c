// SPDX-License-Identifier: MIT
// Tables of a sweep's rows: all of them, and selected ones with their own metrics.
#pragma once

#include "compare/output/document.h"
#include "compare/tradeoff/tradeoff.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::tradeoff {

// Every row. The terminal's columns have fixed widths.
output::Table sweepTable(const Tradeoff& tradeoff);
output::Table sweepHead();
// Rows on the front of time and each error.
using Fronts = std::array<std::vector<std::size_t>, errorFigures.size()>;
output::Row sweepRow(const Tradeoff& tradeoff, std::size_t row, const Fronts& fronts);
inline constexpr std::size_t settingsColumn = 1;

struct FigureTable {
    std::string title, explanation;  // one or two sentences, for the page
    output::Table table;
};

// Row, settings, time, memory and the measures from `first` to `last`; the caller may add columns.
output::Table figureHead(Measure first, Measure last);
// Its cells. The row's Settings include `option`, even at its given value.
output::Row figureRow(const Tradeoff& tradeoff, std::size_t row, std::string_view option, Measure first,
                      Measure last);

// Empty without rows.
std::string inText(const FigureTable& table);
std::vector<output::Block> blocksOf(const FigureTable& table);

}  // namespace diptych::tradeoff
