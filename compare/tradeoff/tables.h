// SPDX-License-Identifier: MIT
// Tables of a sweep's rows: all of them, those with measures of shadows or samples, and tradeoff.csv.
#pragma once

#include "compare/output/document.h"
#include "compare/tradeoff/tradeoff.h"

#include <cstddef>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// Every row. The terminal's columns have fixed widths.
output::Table sweepTable(const Tradeoff& tradeoff);

// The Pareto front of time and one error, for a page.
output::Table frontTable(const Tradeoff& tradeoff, std::size_t metric);

// A row with an evaluated sun shadow. Dominated: another has no more error and no more time (or memory), and
// less of one of them.
struct ShadowRow {
    std::size_t row = 0;  // index
    bool dominated_in_time = false, dominated_in_memory = false;
};
// By ascending error. Empty if the reference traced no shadow-casting sun, or if all rows have equal
// shadows.
std::vector<ShadowRow> shadowRowsOf(const Tradeoff& tradeoff);

// Each table has a heading and an explanation; no blocks without rows.
std::vector<output::Block> shadowBlocks(const Tradeoff& tradeoff);
std::vector<output::Block> sampleBlocks(const Tradeoff& tradeoff);

// tradeoff.csv: a line a row, with all digits.
output::Table csvTable(const Tradeoff& tradeoff);

// Terminal table, written line by line. Lines fit `columns` if it has space for the row's number, time,
// FLIP and some text. Drops other numbers and truncates Settings ("...") to fit. 0: no limit. `commands`:
// prints the measuring command below each row.
class TradeoffTable {
public:
    TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows, std::size_t columns,
                  bool commands);
    std::string head() const;
    std::string line(const Tradeoff& tradeoff, std::size_t row) const;

private:
    output::Table head_;
    std::size_t settings_width_;  // width of the column of Settings
    bool commands_;
};
}  // namespace diptych::tradeoff
