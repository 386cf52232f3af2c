// SPDX-License-Identifier: MIT
// A table of some rows of a sweep by figures of their own, below the one of all rows.
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
    std::string settings;        // in words
    std::vector<double> values;  // one a column
    std::string last{};          // of FigureTable::last_title
};

struct FigureTable {
    std::string title, explanation;  // a sentence or two, for the page
    std::vector<FigureColumn> columns;
    std::vector<FigureRow> rows;
    std::string last_title{};  // of a column of words; empty: there is none
};

// The Settings of a row in words, with `option` even where it has the value that the sweep was given.
std::string settingsInWords(const Tradeoff& tradeoff, std::size_t row, std::string_view option);

// On a terminal, and on the page: with each row's time and memory. Empty without rows.
std::string inText(const Tradeoff& tradeoff, const FigureTable& table);
std::string inHtml(const Tradeoff& tradeoff, const FigureTable& table);

}  // namespace diptych::tradeoff
