// SPDX-License-Identifier: MIT
// The sweep on a terminal.
#include "compare/page/text.h"
#include "compare/tradeoff/sample_figures.h"
#include "compare/tradeoff/shadow_rows.h"
#include "compare/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {

using page::bytes;
using page::number;

TradeoffTable::TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows) {
    for (const Settings& row : rows)
        words_ = std::max(words_, inWords(choicesOf(row, tradeoff.given)).size());
}

std::string TradeoffTable::head() const {
    return fmt::format("{:>4}  {:>8}  {:>8}  {:>8}  {:>8}  {:>13}  {:>12}  {:>10}  {:<{}}  command\n", "row",
                       "ms", "least", "most", errorFigures[0].title, errorFigures[1].title,
                       errorFigures[2].title, "memory", "settings", words_);
}

std::string TradeoffTable::line(const Tradeoff& tradeoff, std::size_t index) const {
    const TradeoffRow& row = tradeoff.rows[index];
    const Spread time = timeOf(row);
    return fmt::format("{:>4}  {:>8.4g}  {:>8.4g}  {:>8.4g}  {:>8}  {:>13}  {:>12}  {:>10}  {:<{}}  {}\n",
                       index + 1, time.value, time.low, time.high, number(row.errors[0]),
                       number(row.errors[1]), number(row.errors[2]), bytes(memoryOf(row)),
                       inWords(choicesOf(row.settings, tradeoff.given)), words_,
                       measuringCommand(tradeoff, row));
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
        lines.push_back(fmt::format("{} of {} rows were measured by a run that was cut short, with its times",
                                    tradeoff.kept, tradeoff.rows.size()));
    if (const std::optional<Spread> drift = driftOf(tradeoff))
        lines.push_back(fmt::format(
            "half of the frames were timed at the end, the last row first: they took {:.3g} times as "
            "long as the first half ({:.3g} to {:.3g} of single rows); between two rows, a smaller "
            "difference than that may be chance",
            drift->value, drift->low, drift->high));
    return lines;
}

std::string tradeoffEnd(const Tradeoff& tradeoff) {
    std::string out;
    for (std::size_t figure = 0; figure < errorFigures.size(); ++figure) {
        std::vector<std::size_t> numbers;
        for (const std::size_t row : frontOf(tradeoff, figure)) numbers.push_back(row + 1);
        out += fmt::format("front of time and {}: row {}\n", errorFigures[figure].title,
                           numbers.empty() ? "none" : fmt::format("{}", fmt::join(numbers, ", ")));
    }
    out += shadowTable(tradeoff);
    out += inText(tradeoff, sampleTable(tradeoff));
    if (driftOf(tradeoff))
        out += "note: times above are of a row's first visit; those of the files are of all its frames\n";
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
