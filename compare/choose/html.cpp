// SPDX-License-Identifier: MIT
#include "compare/choose/html.h"

#include "compare/choose/plot.h"
#include "compare/output/writers.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace diptych::choose {

using experiment::cellOf;
using output::Column;
using output::Heading;
using output::Paragraph;
using output::sorted;
using output::Span;

namespace {

Paragraph commandLine(const char* what, const std::string& command) {
    return {{what, Span(command, Span::command)}, "again"};
}

Span swatchOf(const Settings& settings) {
    return {"", Span::swatch, nameOf(settings.path)};
}

output::List listOf(const std::vector<std::string>& lines, const char* box = "") {
    return {{lines.begin(), lines.end()}, box};
}

Span verdictOf(bool fits) {
    return {fits ? "fits" : "nothing fits", Span::verdict, fits ? "pass" : "fail"};
}

output::Box choiceBox(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    output::Box box{"box", {}};
    if (const std::optional<std::size_t> shown = choice.chosen ? choice.chosen : choice.nearest) {
        box.blocks.emplace_back(Heading{3,
                                        {swatchOf(choice.candidates[*shown].settings),
                                         choice.chosen ? "" : "nearest: ", report.words[*shown]}});
        box.blocks.emplace_back(Paragraph{figuresInWords(report, *shown), "figures mono"});
    }
    box.blocks.emplace_back(listOf(reasonsInWords(report)));
    if (choice.chosen) box.blocks.emplace_back(commandLine("Draw it", report.commands[*choice.chosen]));
    return box;
}

output::Row candidateRow(const ChoiceReport& report, std::size_t i) {
    const Candidate& candidate = report.choice.candidates[i];
    const auto cell = [&](Measure measure) {
        return candidate.measured.has(measure) ? cellOf(candidate, measure)
                                               : sorted(std::numeric_limits<double>::infinity(), "");
    };
    const bool chosen = i == report.choice.chosen;
    return {{output::Text{swatchOf(candidate.settings), report.words[i]}, cell(Measure::ms),
             counted(candidate.timings, "frame"), cell(report.budget.figure), cell(Measure::memory),
             chosen                                          ? "chosen"
             : std::ranges::count(report.choice.ties, i) > 0 ? "tied with the best"
                                                             : statusInWords(candidate.status)},
            chosen ? "chosen" : ""};
}

// The chosen candidate first, then raced ones, then judged ones; each group by time.
output::Table candidateTable(const ChoiceReport& report) {
    std::vector<std::size_t> order(report.choice.candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        const Candidate& candidate = report.choice.candidates[i];
        return std::tuple(i != report.choice.chosen, !candidate.race, !candidate.isJudged(),
                          candidate.log_ms);
    });
    output::Table table{{{"settings", Column::prose},
                         {"ms", Column::number},
                         {"timed"},
                         {report.figure(), Column::number},
                         {"memory", Column::number},
                         {"result"}},
                        {},
                        true};
    for (const std::size_t i : order) table.rows.push_back(candidateRow(report, i));
    return table;
}

void addScene(std::vector<output::Block>& blocks, const ChoiceReport& report, bool titled) {
    if (titled)
        blocks.emplace_back(
            Heading{2, {verdictOf(report.choice.chosen.has_value()), " ", Span(report.scene, Span::name)}});
    const output::Box plot{
        "box",
        {output::Drawing{choicePlot(report, PlotPlace::page)},
         Paragraph{"A bar is the 99 % confidence interval of a candidate's time divided by the fastest "
                   "one's. The line is the smallest error that is possible within a time.",
                   "soft small"}}};
    blocks.emplace_back(output::Box{"choice", {choiceBox(report), plot}});
    if (report.sensitivities) {
        const std::vector<std::string> lines = inWords(*report.sensitivities);
        blocks.emplace_back(Heading{3, lines.front(), "part"});
        blocks.emplace_back(listOf({lines.begin() + 1, lines.end()}, "box says"));
    }
    if (!report.notes.empty()) {
        blocks.emplace_back(Heading{3, "Notes", "part"});
        blocks.emplace_back(listOf(report.notes, "box says"));
    }
    blocks.emplace_back(Heading{3, "Every candidate", "part"});
    blocks.emplace_back(candidateTable(report));
}

output::Row sceneRow(const CommonReport& all, std::size_t shown, std::size_t scene, Measure figure) {
    const experiment::Row& in = all.choice.candidates[shown].scenes[scene];
    output::Row row{{Span(all.scenes[scene], Span::name), cellOf(in, Measure::ms), cellOf(in, figure),
                     cellOf(in, Measure::memory), "", ""}};
    if (!all.choice.chosen || !all.choice.slower[scene]) return row;
    const TimeRatio& slower = *all.choice.slower[scene];
    const auto more = [](double ratio) { return 100 * (ratio - 1); };
    row.cells[4] = sorted(more(slower.ratio), fmt::format("{:.1f}", more(slower.ratio)));
    row.cells[5] = slower.low == slower.high
                       ? "its own choice"
                       : fmt::format("{:.1f} to {:.1f}", more(slower.low), more(slower.high));
    return row;
}

void addCommon(std::vector<output::Block>& blocks, const CommonReport& all, const ChoiceReport& first) {
    const CommonChoice& choice = all.choice;
    const std::optional<std::size_t> shown = choice.chosen ? choice.chosen : choice.nearest;
    output::Box box{"box", {}};
    output::Table table{{{"scene", Column::prose},
                         {"ms", Column::number},
                         {"error", Column::number},
                         {"memory", Column::number},
                         {"slower than its own choice, %", Column::number},
                         {"confidence interval, %", Column::number}},
                        {},
                        true};
    if (shown) {
        box.blocks.emplace_back(Heading{3,
                                        {swatchOf(choice.candidates[*shown].settings),
                                         choice.chosen ? "" : "nearest: ", all.words[*shown]}});
        for (std::size_t scene = 0; scene < all.scenes.size(); ++scene)
            table.rows.push_back(sceneRow(all, *shown, scene, first.budget.figure));
    }
    box.blocks.emplace_back(listOf(reasonsInWords(all, first)));
    if (choice.chosen)
        box.blocks.emplace_back(commandLine("Draw one scene with it", all.commands[*choice.chosen]));
    const std::string title = fmt::format(" One choice for all {} scenes", all.scenes.size());
    blocks.insert(blocks.end(), {Heading{2, {verdictOf(choice.chosen.has_value()), title}}, box, table});
}

}  // namespace

std::string choiceHtml(const Choices& choices, const std::vector<std::string>& files) {
    const ChoiceReport& first = choices.scenes.front();
    const std::string title = choices.all ? fmt::format("{} scenes", choices.scenes.size()) : first.scene;
    output::Document page{
        .title = "a choice, " + title,
        .heading = title,
        .about = {fmt::format("{}; {}x{} on {} ({}); ", goalInWords(first), first.given.size.width,
                              first.given.size.height, first.device.name, first.device.driver),
                  Span(fmt::format("{}", fmt::join(first.cameras, "; ")), Span::foreign)},
        .blocks = {},
        .files = files,
        .style = plotStyle};
    if (choices.all)
        addCommon(page.blocks, *choices.all, first);
    else
        page.heading = {verdictOf(first.choice.chosen.has_value()), " ", title};
    for (const ChoiceReport& report : choices.scenes) addScene(page.blocks, report, choices.all.has_value());
    page.blocks.push_back(experiment::rowsBox(allRows(choices)));
    return inHtml(page);
}

}  // namespace diptych::choose
