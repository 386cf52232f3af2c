// SPDX-License-Identifier: MIT
#include "compare/tradeoff/figure_table.h"

#include "compare/page/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::tradeoff {

using page::bytes;
using page::markup;
using page::number;

std::string settingsInWords(const Tradeoff& tradeoff, std::size_t row, std::string_view option) {
    const Settings& settings = tradeoff.rows[row].settings;
    std::vector<Choice> choices = choicesOf(settings, tradeoff.given);
    const auto named = [&](const Choice& choice) { return choice.first == option; };
    if (std::ranges::none_of(choices, named))
        choices.insert(choices.begin() + 1, {std::string(option), settings.valueOf(option)});
    return inWords(choices);
}

std::string inText(const Tradeoff& tradeoff, const FigureTable& table) {
    if (table.rows.empty()) return {};
    std::string out = table.title + ":\n row        ms      memory";
    for (const FigureColumn& column : table.columns) out += fmt::format("  {:>10}", column.title);
    if (!table.last_title.empty()) out += fmt::format("  {:<12}", table.last_title);
    out += "  settings\n";
    for (const FigureRow& row : table.rows) {
        const TradeoffRow& measured = tradeoff.rows[row.row];
        out += fmt::format("{:>4}  {:>8.4g}  {:>10}", row.row + 1, timeOf(measured).value,
                           bytes(memoryOf(measured)));
        for (const double value : row.values) out += fmt::format("  {:>10}", number(value));
        if (!table.last_title.empty()) out += fmt::format("  {:<12}", row.last);
        out += fmt::format("  {}\n", row.settings);
    }
    return out;
}

std::string inHtml(const Tradeoff& tradeoff, const FigureTable& table) {
    if (table.rows.empty()) return {};
    std::string out = fmt::format(
        "<h2>{}</h2>\n<p class=\"soft\">{}</p><div class=\"box scroll rows\"><table "
        "class=\"stack\"><thead><tr>",
        markup(table.title), markup(table.explanation));
    const auto head = [&](std::string_view title, std::string_view means, bool isNumber) {
        out += fmt::format("<th{}{}><button type=\"button\">{}</button></th>", isNumber ? " class=\"n\"" : "",
                           means.empty() ? "" : fmt::format(" title=\"{}\"", markup(std::string(means))),
                           markup(std::string(title)));
    };
    head("row", {}, false);
    head("settings", {}, false);
    head("ms", "median time of a whole frame", true);
    head("memory", "images and buffers of a frame", true);
    for (const FigureColumn& column : table.columns) head(column.title, column.means, true);
    if (!table.last_title.empty()) head(table.last_title, {}, false);
    out += "</tr></thead>\n<tbody>";
    for (const FigureRow& row : table.rows) {
        const TradeoffRow& measured = tradeoff.rows[row.row];
        out += fmt::format(
            "<tr data-row=\"{0}\"><td>{0}</td><td class=\"whole\"><i class=\"swatch {1}\"></i>{2}</td>",
            row.row + 1, nameOf(measured.settings.path), markup(row.settings));
        const double ms = timeOf(measured).value;
        out += page::numberCell(ms, fmt::format("{:.4g}", ms));
        out += page::numberCell(static_cast<double>(memoryOf(measured)), bytes(memoryOf(measured)));
        for (const double value : row.values) out += page::numberCell(value, number(value));
        if (!table.last_title.empty()) out += fmt::format("<td>{}</td>", markup(row.last));
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

}  // namespace diptych::tradeoff
