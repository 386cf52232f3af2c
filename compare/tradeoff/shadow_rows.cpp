// SPDX-License-Identifier: MIT
#include "compare/tradeoff/shadow_rows.h"

#include "compare/tradeoff/pareto.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {

namespace {

// Marks rows that are not on the Pareto front of error and cost.
template <class Cost>
void markBeaten(std::vector<ShadowRow>& rows, const Cost& cost, bool ShadowRow::*beaten) {
    std::vector<TimeError> points;
    for (const ShadowRow& row : rows) points.push_back({cost(row), row.errors.front()});
    for (ShadowRow& row : rows) row.*beaten = true;
    for (const std::size_t i : paretoFront(points)) rows[i].*beaten = false;
}

std::string beatenIn(const ShadowRow& row) {
    std::vector<std::string> words;
    if (row.dominated_in_time) words.emplace_back("time");
    if (row.dominated_in_memory) words.emplace_back("memory");
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::vector<ShadowRow> shadowRowsOf(const Tradeoff& tradeoff) {
    std::vector<ShadowRow> rows;
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i) {
        const TradeoffRow& row = tradeoff.rows[i];
        if (const std::optional<ShadowErrors> errors = shadowOf(row))
            rows.push_back({i, *errors, timeOf(row).value, memoryOf(row)});
    }
    const auto differs = [&](const ShadowRow& row) { return row.errors != rows.front().errors; };
    if (std::ranges::none_of(rows, differs)) return {};
    std::ranges::stable_sort(rows, {}, [](const ShadowRow& row) { return row.errors.front(); });
    markBeaten(
        rows, [](const ShadowRow& row) { return row.ms; }, &ShadowRow::dominated_in_time);
    markBeaten(
        rows, [](const ShadowRow& row) { return static_cast<double>(row.bytes); },
        &ShadowRow::dominated_in_memory);
    return rows;
}

FigureTable shadowTable(const Tradeoff& tradeoff) {
    FigureTable table{
        "Sun shadow, compared with traced rays",
        "V: fraction of the sun a pixel sees; R: the same in the reference; E: irradiance of the unshadowed "
        "sun. A pixel within the filter radius plus a texel of a traced edge counts as neither false lit nor "
        "false dark. A row is dominated if another has no more error and takes no more time, or memory.",
        figureHead()};
    for (const NamedMetric& figure : shadowFigures) addFigure(table, figure.title, figure.means);
    table.table.columns.push_back({"dominated in", output::Column::words, 12});
    for (const ShadowRow& row : shadowRowsOf(tradeoff)) {
        output::Row& cells =
            table.table.rows.emplace_back(figureRow(tradeoff, row.row, "shadows", row.errors));
        cells.cells.emplace_back(beatenIn(row));
    }
    return table;
}

}  // namespace diptych::tradeoff
