// SPDX-License-Identifier: MIT
// Terminal text of a sweep.
#include "compare/output/writers.h"
#include "compare/tradeoff/figure_table.h"
#include "compare/tradeoff/sample_figures.h"
#include "compare/tradeoff/shadow_rows.h"
#include "compare/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace diptych::tradeoff {

using output::Column;

namespace {

// Columns that a narrow terminal lacks; the first are dropped first.
constexpr std::string_view leftOut[] = {"max", "min", errorFigures[2].title, "memory", errorFigures[1].title};
constexpr std::size_t fewestWords = 24;

}  // namespace

TradeoffTable::TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows, std::size_t columns,
                             bool commands)
    : head_(sweepHead()), words_(std::string_view("settings").size()), commands_(commands) {
    for (const Settings& row : rows)
        words_ = std::max(words_, inWords(choicesOf(row, tradeoff.given)).size());
    std::size_t width = 0;
    for (const Column& column : head_.columns)
        if (column.kind == Column::number) width += column.width + head_.gap;
    for (const std::string_view title : leftOut) {
        if (columns == 0 || width + std::min(words_, fewestWords) <= columns) break;
        Column& column = *std::ranges::find(head_.columns, title, &Column::title);
        column.where = Column::page;
        width -= column.width + head_.gap;
    }
    if (columns > 0) words_ = std::min(words_, std::max(columns - std::min(columns, width), fewestWords));
}

std::string TradeoffTable::head() const {
    return inText(head_);
}

std::string TradeoffTable::line(const Tradeoff& tradeoff, std::size_t index) const {
    const TradeoffRow& row = tradeoff.rows[index];
    output::Table table = head_;
    table.rows = {sweepRow(tradeoff, index, {})};
    if (const std::string words = inWords(row, tradeoff.given); words.size() > words_)
        table.rows[0].cells[settingsColumn] = words.substr(0, words_ - 3) + "...";
    std::string line = inText(table, 1);
    if (commands_)
        line += fmt::format("{:>{}}{}\n", "", table.columns[0].width + table.gap,
                            measuringCommand(tradeoff, row));
    return line;
}

std::vector<std::string> howItWent(const Tradeoff& tradeoff) {
    std::vector<std::string> lines;
    const SweepCost& cost = tradeoff.cost;
    lines.push_back(fmt::format(
        "It took {:.1f} s: {:.1f} s to read and upload the scene, {:.1f} s to draw the reference, "
        "{:.1f} s to draw and time the rows, and {:.1f} s for everything else, such as comparing "
        "them and writing files",
        cost.whole / 1e3, cost.reading / 1e3, cost.reference / 1e3, cost.drawing / 1e3, cost.beyond() / 1e3));
    if (tradeoff.kept > 0)
        lines.push_back(fmt::format("{} of {} rows come from an interrupted run and keep its times",
                                    tradeoff.kept, tradeoff.rows.size()));
    if (const std::optional<Spread> drift = driftOf(tradeoff))
        lines.push_back(
            fmt::format("Frames timed after all rows were drawn, in random order, took {:.3g} times as long "
                        "as each row's first frames ({:.3g} to {:.3g} for single rows): a smaller difference "
                        "between two rows may be chance",
                        drift->value, drift->low, drift->high));
    return lines;
}

std::string frontsText(const Tradeoff& tradeoff) {
    std::string out;
    for (std::size_t figure = 0; figure < errorFigures.size(); ++figure) {
        std::vector<std::size_t> numbers;
        for (const std::size_t row : frontOf(tradeoff, figure)) numbers.push_back(row + 1);
        out += fmt::format("Pareto front of time and {}: {}\n", errorFigures[figure].title,
                           numbers.empty() ? "none"
                                           : fmt::format("row{} {}", numbers.size() == 1 ? "" : "s",
                                                         fmt::join(numbers, ", ")));
    }
    return out;
}

std::string tradeoffEnd(const Tradeoff& tradeoff) {
    std::string out = frontsText(tradeoff);
    out += inText(shadowTable(tradeoff)) + inText(sampleTable(tradeoff));
    if (driftOf(tradeoff))
        out +=
            "note: times above are from each row's first timing block; times in the files are from all its "
            "frames\n";
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        for (const std::string& warning : tradeoff.rows[i].warnings)
            out += fmt::format("warning: row {}: {}\n", i + 1, warning);
    for (const SkipGroup& group : groupsOf(tradeoff.skips))
        out += fmt::format("not drawn: {}: {}\n", fmt::join(group.tried, ", "), group.reason);
    for (const std::string& line : tradeoff.notes) out += "note: " + line + "\n";
    for (const std::string& line : howItWent(tradeoff)) out += line + "\n";
    return out;
}

}  // namespace diptych::tradeoff
