// SPDX-License-Identifier: MIT
#include "compare/tradeoff/shadow_rows.h"

#include "compare/page/text.h"
#include "compare/tradeoff/pareto.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {

using page::bytes;
using page::markup;
using page::number;

namespace {

// Which rows are not on the front of error and of what `cost` gives.
template <class Cost>
void markBeaten(std::vector<ShadowRow>& rows, const Cost& cost, bool ShadowRow::*beaten) {
    std::vector<TimeError> points;
    for (const ShadowRow& row : rows) points.push_back({cost(row), row.errors.front()});
    for (ShadowRow& row : rows) row.*beaten = true;
    for (const std::size_t i : paretoFront(points)) rows[i].*beaten = false;
}

std::string beatenIn(const ShadowRow& row) {
    std::vector<std::string> words;
    if (row.beaten_in_time) words.emplace_back("time");
    if (row.beaten_in_memory) words.emplace_back("memory");
    return fmt::format("{}", fmt::join(words, ", "));
}

std::string settingsOf(const Tradeoff& tradeoff, const ShadowRow& row) {
    const Settings& settings = tradeoff.rows[row.row].settings;
    std::vector<Choice> choices = choicesOf(settings, tradeoff.given);
    const auto named = [](const Choice& choice) { return choice.first == "shadows"; };
    if (std::ranges::none_of(choices, named))
        choices.insert(choices.begin() + 1, {"shadows", settings.valueOf("shadows")});
    return inWords(choices);
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
        rows, [](const ShadowRow& row) { return row.ms; }, &ShadowRow::beaten_in_time);
    markBeaten(
        rows, [](const ShadowRow& row) { return static_cast<double>(row.bytes); },
        &ShadowRow::beaten_in_memory);
    return rows;
}

std::string shadowTable(const Tradeoff& tradeoff) {
    const std::vector<ShadowRow> rows = shadowRowsOf(tradeoff);
    if (rows.empty()) return {};
    std::string out = "shadow of the sun, against traced rays:\n row        ms      memory";
    for (const ShadowFigure& figure : shadowFigures) out += fmt::format("  {:>10}", figure.title);
    out += "  beaten in     settings\n";
    for (const ShadowRow& row : rows) {
        out += fmt::format("{:>4}  {:>8.4g}  {:>10}", row.row + 1, row.ms, bytes(row.bytes));
        for (const double error : row.errors) out += fmt::format("  {:>10}", number(error));
        out += fmt::format("  {:<12}  {}\n", beatenIn(row), settingsOf(tradeoff, row));
    }
    return out;
}

std::string shadowTableHtml(const Tradeoff& tradeoff) {
    const std::vector<ShadowRow> rows = shadowRowsOf(tradeoff);
    if (rows.empty()) return {};
    std::string out =
        "<h2>Shadow of the sun, against traced rays</h2>\n<p class=\"soft\">V: how much of the sun a pixel "
        "sees; "
        "R: in the reference; E: what the sun would give unshadowed. Near a traced edge, within the filter's "
        "reach "
        "and a texel, a pixel is neither false lit nor false dark. A row is beaten where another has no more "
        "error "
        "and takes no more time, or memory.</p><div class=\"box scroll rows\"><table "
        "class=\"stack\"><thead><tr>";
    const auto head = [&](std::string_view title, std::string_view means, bool isNumber) {
        out += fmt::format("<th{}{}><button type=\"button\">{}</button></th>", isNumber ? " class=\"n\"" : "",
                           means.empty() ? "" : fmt::format(" title=\"{}\"", markup(std::string(means))),
                           markup(std::string(title)));
    };
    head("row", {}, false);
    head("settings", {}, false);
    head("ms", "median time of a whole frame", true);
    head("memory", "images and buffers of a frame", true);
    for (const ShadowFigure& figure : shadowFigures) head(figure.title, figure.means, true);
    head("beaten in", {}, false);
    out += "</tr></thead>\n<tbody>";
    for (const ShadowRow& row : rows) {
        out += fmt::format(
            "<tr data-row=\"{0}\"><td>{0}</td><td class=\"whole\"><i class=\"swatch {1}\"></i>{2}</td>",
            row.row + 1, nameOf(tradeoff.rows[row.row].settings.path), markup(settingsOf(tradeoff, row)));
        out += page::numberCell(row.ms, fmt::format("{:.4g}", row.ms));
        out += page::numberCell(static_cast<double>(row.bytes), bytes(row.bytes));
        for (const double error : row.errors) out += page::numberCell(error, number(error));
        out += fmt::format("<td>{}</td></tr>\n", beatenIn(row));
    }
    return out + "</tbody></table></div>\n";
}

}  // namespace diptych::tradeoff
