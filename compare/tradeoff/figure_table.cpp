// SPDX-License-Identifier: MIT
#include "compare/tradeoff/figure_table.h"

#include "compare/output/writers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {

using output::bytesCell;
using output::Cell;
using output::Column;
using output::millisecondsCell;
using output::numberCell;
using output::Span;

namespace {

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
    output::Table table{{{"row", Column::number, 4},
                         {"settings", Column::prose},
                         {"ms", Column::number, 8},
                         {"min", Column::number, 8},
                         {"max", Column::number, 8}}};
    for (const auto& [figure, width] : {std::pair{0, 8}, {1, 13}, {2, 12}})
        table.columns.push_back({std::string(errorFigures.at(static_cast<std::size_t>(figure)).title),
                                 Column::number, static_cast<std::size_t>(width)});
    table.columns.insert(table.columns.end(), {{"memory", Column::number, 10},
                                               {"front", Column::words, 0, Column::page},
                                               {"command", Column::prose, 0, Column::page}});
    table.sortable = true;
    return table;
}

output::Row sweepRow(const Tradeoff& tradeoff, std::size_t index, const Fronts& fronts) {
    const TradeoffRow& row = tradeoff.rows[index];
    const Spread time = timeOf(row);
    output::Row cells{{fmt::format("{}", index + 1), settingsCell(row, inWords(row, tradeoff.given)),
                       millisecondsCell(time.value), millisecondsCell(time.low), millisecondsCell(time.high)},
                      "",
                      index + 1};
    std::vector<std::string_view> on;
    for (std::size_t f = 0; f < errorFigures.size(); ++f) {
        cells.cells.push_back(numberCell(row.errors[f]));
        if (std::ranges::count(fronts[f], index) > 0) on.push_back(errorFigures[f].title);
    }
    cells.cells.insert(cells.cells.end(), {bytesCell(memoryOf(row)), fmt::format("{}", fmt::join(on, ", ")),
                                           Span(measuringCommand(tradeoff, row), Span::command)});
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

output::Table figureHead() {
    return {
        .columns = {{"row", Column::number, 4},
                    {"settings", Column::prose},
                    {"ms", Column::number, 8, Column::everywhere, "", "median time of a whole frame"},
                    {"memory", Column::number, 10, Column::everywhere, "", "images and buffers of a frame"}},
        .sortable = true};
}

void addFigure(FigureTable& table, std::string_view title, std::string_view means) {
    table.table.columns.push_back(
        {std::string(title), Column::number, 10, Column::everywhere, "", std::string(means)});
}

output::Row figureRow(const Tradeoff& tradeoff, std::size_t index, std::string_view option,
                      std::span<const double> figures) {
    const TradeoffRow& row = tradeoff.rows[index];
    output::Row cells{
        {fmt::format("{}", index + 1), settingsCell(row, settingsInWords(tradeoff, row.settings, option)),
         millisecondsCell(timeOf(row).value), bytesCell(memoryOf(row))},
        "",
        index + 1};
    for (const double value : figures) cells.cells.push_back(numberCell(value));
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
