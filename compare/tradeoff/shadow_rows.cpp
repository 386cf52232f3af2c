// SPDX-License-Identifier: MIT
#include "compare/tradeoff/shadow_rows.h"

#include "compare/experiment/pareto.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {

namespace {

// Marks rows that are not on the Pareto front of error and cost.
void markBeaten(const Tradeoff& tradeoff, std::vector<ShadowRow>& rows, Measure cost,
                bool ShadowRow::*beaten) {
    std::vector<experiment::TimeError> points;
    for (const ShadowRow& row : rows)
        points.push_back({tradeoff.rows[row.row][cost], tradeoff.rows[row.row][Measure::shadow_error]});
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
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        if (tradeoff.rows[i].measured.has(Measure::shadow_error)) rows.push_back({i});
    const auto differs = [&](const ShadowRow& row) {
        for (std::size_t f = 0; f < shadowFigures.size(); ++f)
            if (tradeoff.rows[row.row][Measure::shadow_error + f] !=
                tradeoff.rows[rows.front().row][Measure::shadow_error + f])
                return true;
        return false;
    };
    if (std::ranges::none_of(rows, differs)) return {};
    std::ranges::stable_sort(
        rows, {}, [&](const ShadowRow& row) { return tradeoff.rows[row.row][Measure::shadow_error]; });
    markBeaten(tradeoff, rows, Measure::ms, &ShadowRow::dominated_in_time);
    markBeaten(tradeoff, rows, Measure::memory, &ShadowRow::dominated_in_memory);
    return rows;
}

FigureTable shadowTable(const Tradeoff& tradeoff) {
    FigureTable table{
        "Sun shadow, compared with traced rays",
        "V: fraction of the sun a pixel sees; R: the same in the reference; E: irradiance of the unshadowed "
        "sun. A pixel within the filter radius plus a texel of a traced edge counts as neither false lit nor "
        "false dark. A row is dominated if another has no more error and takes no more time, or memory.",
        figureHead(Measure::shadow_error, Measure::gap)};
    table.table.columns.push_back({"dominated in", output::Column::words, 12});
    for (const ShadowRow& row : shadowRowsOf(tradeoff))
        table.table.rows
            .emplace_back(figureRow(tradeoff, row.row, "shadows", Measure::shadow_error, Measure::gap))
            .cells.emplace_back(beatenIn(row));
    return table;
}

}  // namespace diptych::tradeoff
