// SPDX-License-Identifier: MIT
// Terminal text of a sweep.
#include "compare/page/text.h"
#include "compare/tradeoff/sample_figures.h"
#include "compare/tradeoff/shadow_rows.h"
#include "compare/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace diptych::tradeoff {

using page::bytes;
using page::number;

namespace {

// A numeric column: title, width, and priority. Columns with the largest `left_out` are dropped first if
// the terminal is narrow; 0 is never dropped.
struct Number {
    std::string_view title;
    std::size_t width;
    int left_out;
};
constexpr std::array numbers{
    Number{"row", 4, 0},
    Number{"ms", 8, 0},
    Number{"min", 8, 4},
    Number{"max", 8, 5},
    Number{errorFigures[0].title, 8, 0},
    Number{errorFigures[1].title, 13, 1},
    Number{errorFigures[2].title, 12, 3},
    Number{"memory", 10, 2},
};
constexpr std::size_t gap = 2, fewestWords = 24;

}  // namespace

TradeoffTable::TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows, std::size_t columns,
                             bool commands)
    : words_(std::string_view("settings").size()), commands_(commands) {
    for (const Settings& row : rows)
        words_ = std::max(words_, inWords(choicesOf(row, tradeoff.given)).size());
    std::size_t width = 0;
    for (const Number& one : numbers) width += one.width + gap;
    int left_out = 6;  // columns from this value on are dropped
    while (columns > 0 && left_out > 1 && width + std::min(words_, fewestWords) > columns) {
        --left_out;
        for (const Number& one : numbers)
            if (one.left_out == left_out) width -= one.width + gap;
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers.at(i).left_out < left_out) shown_.push_back(i);
    if (columns > 0) words_ = std::min(words_, std::max(columns - std::min(columns, width), fewestWords));
}

std::string TradeoffTable::joined(const std::vector<std::string>& cells, const std::string& words) const {
    std::string line;
    for (const std::size_t i : shown_)
        line += fmt::format("{:>{}}{:{}}", cells.at(i), numbers.at(i).width, "", gap);
    return line + (words.size() <= words_ ? words : words.substr(0, words_ - 3) + "...") + "\n";
}

std::string TradeoffTable::head() const {
    std::vector<std::string> titles;
    for (const Number& one : numbers) titles.emplace_back(one.title);
    return joined(titles, "settings");
}

std::string TradeoffTable::line(const Tradeoff& tradeoff, std::size_t index) const {
    const TradeoffRow& row = tradeoff.rows[index];
    const Spread time = timeOf(row);
    const auto ms = [](double value) { return fmt::format("{:.4g}", value); };
    std::string line =
        joined({fmt::format("{}", index + 1), ms(time.value), ms(time.low), ms(time.high),
                number(row.errors[0]), number(row.errors[1]), number(row.errors[2]), bytes(memoryOf(row))},
               inWords(row, tradeoff.given));
    if (commands_)
        line += fmt::format("{:>{}}{}\n", "", numbers[0].width + gap, measuringCommand(tradeoff, row));
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

std::string tradeoffEnd(const Tradeoff& tradeoff) {
    std::string out;
    for (std::size_t figure = 0; figure < errorFigures.size(); ++figure) {
        std::vector<std::size_t> numbers;
        for (const std::size_t row : frontOf(tradeoff, figure)) numbers.push_back(row + 1);
        out += fmt::format("Pareto front of time and {}: {}\n", errorFigures[figure].title,
                           numbers.empty() ? "none"
                                           : fmt::format("row{} {}", numbers.size() == 1 ? "" : "s",
                                                         fmt::join(numbers, ", ")));
    }
    out += shadowTable(tradeoff);
    out += inText(tradeoff, sampleTable(tradeoff));
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
