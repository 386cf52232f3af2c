// SPDX-License-Identifier: MIT
#include "compare/tradeoff/figure_table.h"

#include "compare/output/writers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace diptych::tradeoff {

using experiment::cellOf;
using experiment::columnOf;
using output::Cell;
using output::Column;
using output::Span;

namespace {

// Columns of every row, and their widths in a terminal.
constexpr std::pair<Measure, std::size_t> sweepMeasures[] = {
    {Measure::ms, 8},     {Measure::ms_min, 8},         {Measure::ms_max, 8},
    {Measure::flip, 8},   {Measure::relative_rmse, 13}, {Measure::relative_p99, 12},
    {Measure::memory, 10}};

Cell settingsCell(const TradeoffRow& row, const std::string& words) {
    return output::Text{Span("", Span::swatch, nameOf(row.settings.path)), words};
}

std::string settingsInWords(const Tradeoff& tradeoff, const Settings& settings, std::string_view option) {
    std::vector<Choice> choices = choicesOf(settings, tradeoff.given);
    const auto named = [&](const Choice& choice) { return choice.first == option; };
    if (std::ranges::none_of(choices, named))
        choices.insert(choices.begin() + 1, {std::string(option), settings.valueOf(option)});
    return inWords(choices);
}

}  // namespace

output::Table sweepHead() {
    output::Table table{{{"row", Column::number, 4}, {"settings", Column::prose}}};
    for (const auto& [measure, width] : sweepMeasures) table.columns.push_back(columnOf(measure, width));
    table.columns.insert(table.columns.end(), {{"front", Column::words, 0, Column::page},
                                               {"command", Column::prose, 0, Column::page}});
    table.sortable = true;
    return table;
}

output::Row sweepRow(const Tradeoff& tradeoff, std::size_t index, const Fronts& fronts) {
    const TradeoffRow& row = tradeoff.rows[index];
    output::Row cells{
        {fmt::format("{}", index + 1), settingsCell(row, inWords(row, tradeoff.given))}, "", index + 1};
    for (const auto& [measure, width] : sweepMeasures) cells.cells.push_back(cellOf(row, measure));
    std::vector<std::string_view> on;
    for (std::size_t f = 0; f < errorFigures.size(); ++f)
        if (std::ranges::count(fronts[f], index) > 0) on.push_back(errorFigures[f].title);
    cells.cells.emplace_back(fmt::format("{}", fmt::join(on, ", ")));
    cells.cells.emplace_back(Span(measuringCommand(tradeoff, row), Span::command));
    return cells;
}

output::Table sweepTable(const Tradeoff& tradeoff) {
    output::Table table = sweepHead();
    Fronts fronts;
    for (std::size_t f = 0; f < fronts.size(); ++f) fronts[f] = frontOf(tradeoff, f);
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        table.rows.push_back(sweepRow(tradeoff, i, fronts));
    return table;
}

output::Table figureHead(Measure first, Measure last) {
    output::Table table{{{"row", Column::number, 4},
                         {"settings", Column::prose},
                         columnOf(Measure::ms, 8),
                         columnOf(Measure::memory, 10)}};
    table.sortable = true;
    for (Measure measure = first; measure <= last; measure = measure + 1)
        table.columns.push_back(columnOf(measure, 10));
    return table;
}

output::Row figureRow(const Tradeoff& tradeoff, std::size_t index, std::string_view option, Measure first,
                      Measure last) {
    const TradeoffRow& row = tradeoff.rows[index];
    output::Row cells{
        {fmt::format("{}", index + 1), settingsCell(row, settingsInWords(tradeoff, row.settings, option)),
         cellOf(row, Measure::ms), cellOf(row, Measure::memory)},
        "",
        index + 1};
    for (Measure measure = first; measure <= last; measure = measure + 1)
        cells.cells.push_back(cellOf(row, measure));
    return cells;
}

std::string inText(const FigureTable& table) {
    return table.table.rows.empty() ? "" : table.title + ":\n" + inText(table.table);
}

std::vector<output::Block> blocksOf(const FigureTable& table) {
    if (table.table.rows.empty()) return {};
    return {output::Heading{2, table.title}, output::Paragraph{table.explanation, "soft"}, table.table};
}

}  // namespace diptych::tradeoff
