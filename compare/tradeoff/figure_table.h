// SPDX-License-Identifier: MIT
// A table of selected rows of a sweep with their own metrics, below the main table.
#pragma once

#include "compare/tradeoff/tradeoff.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::tradeoff {

struct FigureColumn {
    std::string_view title, means;
};

struct FigureRow {
    std::size_t row = 0;         // index in the sweep
    std::string settings;        // as text
    std::vector<double> values;  // one per column
    std::string last{};          // cell of FigureTable::last_title
};

struct FigureTable {
    std::string title, explanation;  // one or two sentences, for the page
    std::vector<FigureColumn> columns;
    std::vector<FigureRow> rows;
    std::string last_title{};  // title of a text column; empty: no such column
};

// A row's Settings as text. Always includes `option`, even at its given value.
std::string settingsInWords(const Tradeoff& tradeoff, std::size_t row, std::string_view option);

// For a terminal, and for the page. Includes each row's time and memory. Empty without rows.
std::string inText(const Tradeoff& tradeoff, const FigureTable& table);
std::string inHtml(const Tradeoff& tradeoff, const FigureTable& table);

}  // namespace diptych::tradeoff
