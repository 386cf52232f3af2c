// SPDX-License-Identifier: MIT
#include "compare/audit/words.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace diptych::audit {

using output::Column;
using output::Heading;
using output::numberCell;
using output::Paragraph;
using output::Span;

namespace {

// The range that every series of every quantity meets.
output::Table tableOf(const Audit& audit) {
    output::Table table{{{"quantity"}, {"settings"}}, {}, true};
    for (const Criterion& criterion : criteria) table.columns.push_back({std::string(criterion.title)});
    for (const char* title : {"predicted, 1e-3", "predicted, 1e-2", "agree"})
        table.columns.push_back({title});
    for (const QuantityAudit& of : audit.quantities)
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            const std::string_view name = of.quantity->name;
            output::Row row{{Span(name, Span::link, fmt::format("#{}", name)),
                             seriesText(of.series[s], of.series[s].words())}};
            for (std::size_t c = 0; c < criterionCount; ++c) {
                const ValidRange& range = of.valid_ranges[c][s];
                const bool whole = range.at_original && !range.up.broken && !range.down.broken;
                row.cells.push_back(output::styled(rangeInWords(range), whole ? "" : "broken"));
            }
            std::optional<bool> agree;
            for (std::size_t c = 0; c < of.predicted.size(); ++c) {
                const Predicted& predicted = of.predicted[c][s];
                row.cells.push_back(output::styled(rangeInWords(predicted, of), "", predicted.because));
                if (const auto one = agrees(of, c, s)) agree = agree.value_or(true) && *one;
            }
            row.cells.emplace_back(!agree ? "" : *agree ? "yes" : "no");
            table.rows.push_back(std::move(row));
        }
    return table;
}

output::Table stepsOf(const QuantityAudit& of) {
    output::Table table{{{"magnitude", Column::number},
                         {"settings"},
                         {"light", Column::number},
                         {"depth", Column::number},
                         {"FLIP", Column::number},
                         {"misplaced", Column::number},
                         {"NaN or infinite", Column::number}},
                        {},
                        true};
    table.box = "scroll rows";
    for (const Step& step : of.steps)
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            const Outcome& outcome = step.outcomes[s];
            table.rows.push_back(
                {{output::sorted(step.magnitude, magnitudeInWords(step.magnitude)),
                  seriesText(of.series[s],
                             of.series[s].words() + (outcome.failed.empty() ? "" : ": " + outcome.failed)),
                  cellOf(outcome, Measure::light_p99), cellOf(outcome, Measure::depth_p99),
                  cellOf(outcome, Measure::flip), cellOf(outcome, Measure::misplaced_pixels),
                  cellOf(outcome, Measure::nonfinite_pixels)}});
        }
    return table;
}

output::Box sectionOf(const QuantityAudit& of) {
    const Quantity& quantity = *of.quantity;
    output::Box box{
        "box",
        {Heading{3, quantity.name},
         Paragraph{fmt::format("{}; here {} {}", quantity.what, magnitudeInWords(of.original), quantity.unit),
                   "soft"},
         output::Drawing{auditPlot(of, PlotPlace::page)}},
        std::string(quantity.name)};
    std::vector<std::string> reasons;
    for (const std::vector<Predicted>& predicted : of.predicted)
        for (const Predicted& one : predicted)
            if (!one.because.empty() && std::ranges::count(reasons, one.because) == 0)
                reasons.push_back(one.because);
    for (const std::string& reason : reasons)
        box.blocks.emplace_back(Paragraph{"Predicted: " + reason, "soft small"});
    for (const std::string& left : of.left_out)
        box.blocks.emplace_back(Paragraph{"No series of its own: " + left, "soft small"});
    for (const Failure& failure : of.failures)
        box.blocks.emplace_back(Paragraph{{failure.words, Span(failure.command, Span::command)}, "again"});
    box.blocks.emplace_back(output::Box{"", {stepsOf(of)}, "", "Every step"});
    return box;
}

}  // namespace

std::string pageOf(const Audited& audited, const std::string& title, const std::string& about,
                   std::optional<bool> passes, std::vector<output::Block> blocks,
                   const std::vector<std::string>& files) {
    const std::vector<std::string>& notes = audited.notes;
    if (!notes.empty())
        blocks.insert(blocks.end(),
                      {Heading{3, "Notes", "part"}, output::List{{notes.begin(), notes.end()}, "box says"}});
    output::Document page{
        .title = title + ", " + audited.scene,
        .heading = Span(audited.scene, Span::name),
        .about = {fmt::format("{}; {}x{} on {} ({}); ", about, audited.settings.size.width,
                              audited.settings.size.height, audited.device.name, audited.device.driver),
                  Span(audited.camera, Span::foreign)},
        .blocks = std::move(blocks),
        .files = files};
    const char* const verdict = passes.value_or(true) ? "pass" : "fail";
    if (passes) page.heading = {Span(verdict, Span::verdict, verdict), " ", Span(audited.scene, Span::name)};
    return inHtml(page);
}

output::Text seriesText(const Series& series, const std::string& words) {
    return {Span("", Span::swatch, nameOf(series.path)), words};
}

std::string auditHtml(const Audit& audit, const std::vector<std::string>& files) {
    std::optional<bool> passes;
    output::List requirements{{}, "box says"};
    for (const Requirement& requirement : audit.requirements) {
        passes = passes.value_or(true) && requirement.met;
        requirements.items.emplace_back(inWords(requirement));
    }
    output::Box sections{"audit", {}};
    Audited noted = audit;
    if (!audit.to_come.empty())
        noted.notes.push_back(fmt::format("still being measured: {}", fmt::join(audit.to_come, ", ")));
    for (const QuantityAudit& of : audit.quantities)
        if (of.lacks.empty())
            sections.blocks.emplace_back(sectionOf(of));
        else
            noted.notes.push_back(fmt::format("{} was not varied: {}", of.quantity->name, of.lacks));
    return pageOf(
        noted, "an audit", "where each path breaks, varying one quantity at a time", passes,
        {requirements, Heading{2, "Range in which each path holds"}, tableOf(audit),
         Paragraph{"The error is the larger of two 99th percentiles over the pixels that show a surface: of "
                   "lit against a double-precision reference that shades the surfaces forward+ captures, and "
                   "of view depth against rays traced in double precision. Predictions say how far float32 "
                   "and double should hold if Settings add no other rounding. A prediction agrees with a "
                   "measurement within a factor of 2.",
                   "soft small"},
         Heading{2, "Error by magnitude"}, sections},
        files);
}

std::string writeAudit(const Audit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, auditManifest, force);
    folder.put("audit.csv", toCsv(audit));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(allRows(audit))));
    for (const QuantityAudit& quantity : audit.quantities)
        if (!quantity.steps.empty())
            folder.put(std::string(quantity.quantity->name) + ".svg", auditPlot(quantity, PlotPlace::file));
    for (const auto& [name, text] : audit.scenes) folder.put(name, text);
    folder.put("index.html", auditHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
