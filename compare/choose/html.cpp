// SPDX-License-Identifier: MIT
#include "compare/choose/html.h"

#include "compare/choose/page/page.h"
#include "compare/choose/plot.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace diptych::choose {

using page::markup;
using page::number;

namespace {

std::string commandLine(const char* what, const std::string& command) {
    return fmt::format(
        "<p class=\"again\">{}<code>{}</code><button type=\"button\" data-do=\"copy\">copy</button></p>",
        what, markup(command));
}

std::string pathSwatch(const Settings& settings) {
    return fmt::format("<i class=\"swatch {}\"></i>", nameOf(settings.path));
}

// Formats lines of terminal text as a list.
std::string listOf(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += "<li>" + markup(line) + "</li>";
    return out.empty() ? out : "<ul>" + out + "</ul>";
}

std::string verdictOf(bool fits) {
    return fmt::format("<span class=\"verdict {}\">{}</span> ", fits ? "pass" : "fail",
                       fits ? "fits" : "nothing fits");
}

std::string choiceBox(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    const std::optional<std::size_t> shown = choice.chosen ? choice.chosen : choice.nearest;
    std::string out = "<div class=\"box\">";
    if (shown)
        out += fmt::format("<h3>{}{}{}</h3><p class=\"figures mono\">{}</p>",
                           pathSwatch(choice.candidates[*shown].settings),
                           choice.chosen ? "" : "nearest: ", markup(report.words[*shown]),
                           markup(figuresInWords(report, *shown)));
    out += listOf(reasonsInWords(report));
    if (choice.chosen) out += commandLine("Draw it", report.commands[*choice.chosen]);
    return out + "</div>";
}

std::string candidateRow(const ChoiceReport& report, std::size_t i) {
    const Candidate& candidate = report.choice.candidates[i];
    const double ms = candidate.ms();
    std::string out = fmt::format("<tr{}><td class=\"whole\">{}{}</td>",
                                  i == report.choice.chosen ? " class=\"chosen\"" : "",
                                  pathSwatch(candidate.settings), markup(report.words[i]));
    out += candidate.timings > 0 ? page::numberCell(ms, fmt::format("{:.4g}", ms))
                                 : std::string("<td class=\"n\" data-value=\"inf\"></td>");
    out += fmt::format("<td>{}</td>", counted(candidate.timings, "frame"));
    if (candidate.judged) {
        out += page::numberCell(candidate.judged->error, number(candidate.judged->error));
        out += page::numberCell(static_cast<double>(candidate.judged->bytes),
                                page::bytes(candidate.judged->bytes));
    } else {
        out += "<td class=\"n\" data-value=\"inf\"></td><td class=\"n\" data-value=\"inf\"></td>";
    }
    std::string status = statusInWords(candidate.status);
    if (i == report.choice.chosen)
        status = "chosen";
    else if (std::ranges::count(report.choice.ties, i) > 0)
        status = "tied with the best";
    return out + fmt::format("<td>{}</td></tr>\n", status);
}

// The chosen candidate first, then raced ones, then judged ones; each group by time.
std::string candidateTable(const ChoiceReport& report) {
    std::vector<std::size_t> order(report.choice.candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        const Candidate& candidate = report.choice.candidates[i];
        return std::tuple(i != report.choice.chosen, !candidate.race_time, !candidate.judged,
                          candidate.log_ms);
    });
    std::string out =
        "<h3 class=\"part\">Every candidate</h3><div class=\"box scroll rows\"><table "
        "class=\"stack\"><thead><tr>";
    for (const auto& [head, kind] : {std::pair{std::string("settings"), ""},
                                     {"ms", " class=\"n\""},
                                     {"timed", ""},
                                     {report.figure, " class=\"n\""},
                                     {"memory", " class=\"n\""},
                                     {"result", ""}})
        out += fmt::format("<th{}><button type=\"button\">{}</button></th>", kind, markup(head));
    out += "</tr></thead>\n<tbody>";
    for (const std::size_t i : order) out += candidateRow(report, i);
    return out + "</tbody></table></div>\n";
}

std::string sceneSection(const ChoiceReport& report, bool titled) {
    std::string out;
    if (titled)
        out += fmt::format("<h2>{}{}</h2>\n", verdictOf(report.choice.chosen.has_value()),
                           page::breakable(report.scene));
    out +=
        "<div class=\"choice\">" + choiceBox(report) + "<div class=\"box\">" +
        choicePlot(report, PlotPlace::page) +
        "<p class=\"soft small\">A bar is the 99 % confidence interval of a candidate's time divided by the "
        "fastest one's. The line is the smallest error that is possible within a time.</p></div></div>\n";
    if (report.sensitivities) {
        const std::vector<std::string> lines = inWords(*report.sensitivities);
        out += fmt::format("<h3 class=\"part\">{}</h3><div class=\"box says\">{}</div>\n",
                           markup(lines.front()), listOf({lines.begin() + 1, lines.end()}));
    }
    if (!report.notes.empty())
        out += "<h3 class=\"part\">Notes</h3><div class=\"box says\">" + listOf(report.notes) + "</div>\n";
    return out + candidateTable(report);
}

std::string commonSection(const CommonReport& all, const ChoiceReport& first) {
    const CommonChoice& choice = all.choice;
    const std::optional<std::size_t> shown = choice.chosen ? choice.chosen : choice.nearest;
    std::string out = fmt::format("<h2>{}One choice for all {} scenes</h2>\n<div class=\"box\">",
                                  verdictOf(choice.chosen.has_value()), all.scenes.size());
    if (shown)
        out += fmt::format("<h3>{}{}{}</h3>", pathSwatch(choice.candidates[*shown].settings),
                           choice.chosen ? "" : "nearest: ", markup(all.words[*shown]));
    out += listOf(reasonsInWords(all, first));
    if (choice.chosen) out += commandLine("Draw one scene with it", all.commands[*choice.chosen]);
    out += "</div><div class=\"box scroll rows\"><table class=\"stack\"><thead><tr>";
    for (const char* head :
         {"scene", "ms", "error", "memory", "slower than its own choice, %", "confidence interval, %"})
        out += fmt::format("<th{}><button type=\"button\">{}</button></th>",
                           std::string_view(head) == "scene" ? "" : " class=\"n\"", head);
    out += "</tr></thead>\n<tbody>";
    for (std::size_t scene = 0; shown && scene < all.scenes.size(); ++scene) {
        const InScene& in = choice.candidates[*shown].scenes[scene];
        out += fmt::format("<tr><td class=\"whole\">{}</td>", page::breakable(all.scenes[scene]));
        out += in.ms > 0 ? page::numberCell(in.ms, fmt::format("{:.4g}", in.ms))
                         : std::string("<td class=\"n\"></td>");
        out += page::numberCell(in.judged.error, number(in.judged.error)) +
               page::numberCell(static_cast<double>(in.judged.bytes), page::bytes(in.judged.bytes));
        if (choice.chosen && choice.slower[scene]) {
            const Slowdown& slower = *choice.slower[scene];
            const auto more = [](double ratio) { return 100 * (ratio - 1); };
            out += page::numberCell(more(slower.ratio), fmt::format("{:.1f}", more(slower.ratio)));
            out += slower.low == slower.high ? "<td class=\"n\">its own choice</td></tr>\n"
                                             : fmt::format("<td class=\"n\">{:.1f} to {:.1f}</td></tr>\n",
                                                           more(slower.low), more(slower.high));
        } else {
            out += "<td class=\"n\"></td><td class=\"n\"></td></tr>\n";
        }
    }
    return out + "</tbody></table></div>\n";
}

}  // namespace

std::string choiceHtml(const Choices& choices, const std::vector<std::string>& files) {
    const ChoiceReport& first = choices.scenes.front();
    const std::string title = choices.all ? fmt::format("{} scenes", choices.scenes.size()) : first.scene;
    std::string out = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: a choice, "
        "{}</title>\n<style>{}{}{}</style></head>\n<body>\n<header><p "
        "class=\"brand\">Diptych</p><h1>{}{}</h1><p class=\"soft\">{}; {}x{} on {} ({}); {}</p></header>\n",
        markup(title), page::style, plotStyle, choiceStyle,
        choices.all ? "" : verdictOf(first.choice.chosen.has_value()), markup(title),
        markup(goalInWords(first)), first.given.size.width, first.given.size.height,
        markup(first.device.name), markup(first.device.driver),
        page::isolated(fmt::format("{}", fmt::join(first.cameras, "; "))));
    if (choices.all) out += commonSection(*choices.all, first);
    for (const ChoiceReport& report : choices.scenes) out += sceneSection(report, choices.all.has_value());
    out += "<footer><p>";
    for (const std::string& file : files) out += fmt::format("<a href=\"{0}\">{0}</a> ", file);
    return out + fmt::format("</p></footer><script>{}{}{}</script>\n</body></html>\n", page::tables,
                             page::copying, choiceScript);
}

}  // namespace diptych::choose
