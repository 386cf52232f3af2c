// SPDX-License-Identifier: MIT
#include "compare/audit/report.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace diptych::audit {

using output::Block;
using output::Column;
using output::Heading;
using output::Paragraph;
using output::Span;

namespace {

// Text of a range between optional ends.
std::string rangeOf(std::optional<double> from, std::optional<double> to) {
    if (from && to) return magnitudeText(*from) + " to " + magnitudeText(*to);
    if (to) return "up to " + magnitudeText(*to);
    return from ? "down to " + magnitudeText(*from) : "whole range";
}

// A row for each series; a page also has the predictions.
output::Table rangesOf(std::span<const QuantityAudit> all) {
    output::Table table{{{"quantity", Column::text, 0, Column::page}, {"settings"}}, {}, true};
    table.indent = 2;
    for (const BreakCriterion& criterion : criteria) table.columns.push_back({std::string(criterion.title)});
    for (const char* title : {"predicted, 1e-3", "predicted, 1e-2"})
        table.columns.push_back({title, Column::text, 0, Column::page});
    for (const QuantityAudit& of : all)
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            const std::string_view name = of.quantity->name;
            output::Row row{{Span(name, Span::link, fmt::format("#{}", name)),
                             seriesText(of.series[s], of.series[s].describe())}};
            for (const std::vector<ValidRange>& ranges : of.valid_ranges) {
                const ValidRange& range = ranges[s];
                const bool whole = range.at_original && !range.up.broken && !range.down.broken;
                row.cells.push_back(output::styled(rangeText(range), whole ? "" : "broken"));
            }
            for (std::size_t c = 0; c < of.predicted.size(); ++c)
                row.cells.push_back(output::styled(rangeText(of.predicted[c][s], of),
                                                   agrees(of, c, s).value_or(true) ? "" : "broken",
                                                   of.predicted[c][s].because));
            table.rows.push_back(std::move(row));
        }
    return table;
}

output::List remarksOn(const QuantityAudit& of) {
    output::List list{{}, "how soft small"};
    std::vector<std::string> reasons;
    for (std::size_t s = 0; s < of.series.size(); ++s) {
        const std::string series = of.series[s].describe();
        for (std::size_t c = 0; c < of.predicted.size(); ++c) {
            const Predicted& predicted = of.predicted[c][s];
            if (!predicted.because.empty() && std::ranges::count(reasons, predicted.because) == 0)
                reasons.push_back(predicted.because);
            if (!agrees(of, c, s).value_or(true))
                list.items.emplace_back(
                    fmt::format("{}: {} was predicted {}, which differs from the measurement", series,
                                criteria[c].title, rangeText(predicted, of)));
        }
        // The first step of each kind.
        bool infinite = false, failed = false;
        for (const Step& step : of.steps) {
            const Outcome& outcome = step.outcomes[s];
            const std::uint64_t pixels = outcome.whole(Measure::nonfinite_pixels);
            const std::string at = magnitudeText(step.magnitude, *of.quantity);
            if (pixels > 0 && !std::exchange(infinite, true))
                list.items.emplace_back(fmt::format("{}: {} NaN or infinite at {}, the first at {},{}",
                                                    series, counted(pixels, "pixel"), at, outcome.worst_x,
                                                    outcome.worst_y));
            if (!outcome.failed.empty() && !std::exchange(failed, true))
                list.items.emplace_back(fmt::format("{}: not drawn at {}: {}", series, at, outcome.failed));
        }
    }
    for (const std::string& reason : reasons) list.items.emplace_back("predicted: " + reason);
    for (const std::string& left : of.omitted) list.items.emplace_back("no series of its own: " + left);
    return list;
}

std::string notVaried(const QuantityAudit& of) {
    return fmt::format("{}: not varied: {}", of.quantity->name, of.lacks);
}

std::string auditHtml(const Audit& audit, const std::vector<std::string>& files) {
    output::Box sections{"audit", {}};
    Audited noted = audit;
    if (!audit.to_come.empty())
        noted.notes.push_back(fmt::format("still being measured: {}", fmt::join(audit.to_come, ", ")));
    for (const QuantityAudit& of : audit.quantities)
        if (of.lacks.empty())
            sections.blocks.emplace_back(output::Box{"box", blocksOf(of), std::string(of.quantity->name)});
        else
            noted.notes.push_back(notVaried(of));
    std::vector<Block> blocks;
    const bool required = !audit.requirements.empty();
    if (required) blocks.emplace_back(output::Box{"box says", closingOf(audit)});
    blocks.insert(
        blocks.end(),
        {Heading{2, "Range in which each path holds"}, rangesOf(audit.quantities),
         Paragraph{"The error is the larger of two 99th percentiles over the pixels that show a surface: of "
                   "lit against a double-precision reference that shades the surfaces forward+ captures, and "
                   "of view depth against rays traced in double precision. An error is not visible if the "
                   "mean HDR-FLIP is below 0.05. Predictions say how far float32 and double should hold if "
                   "Settings add no other rounding. A prediction agrees with a measurement within a factor "
                   "of 2.",
                   "soft small"},
         Heading{2, "Error by magnitude"}, sections});
    return pageOf(noted, "an audit", "where each path breaks, varying one quantity at a time",
                  required ? std::optional(audit.passes()) : std::nullopt, std::move(blocks), files);
}

}  // namespace

std::string pageOf(const Audited& audited, const std::string& title, const std::string& about,
                   std::optional<bool> passes, std::vector<Block> blocks,
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
    if (passes) {
        const char* const verdict = *passes ? "pass" : "fail";
        page.heading = {Span(verdict, Span::verdict, verdict), " ", Span(audited.scene, Span::name)};
    }
    return inHtml(page);
}

output::Text seriesText(const Series& series, const std::string& sentence) {
    return {Span("", Span::swatch, nameOf(series.path)), sentence};
}

std::string magnitudeText(double magnitude) {
    return fmt::format("{:.3g}", magnitude);
}

std::string magnitudeText(double magnitude, const Quantity& quantity) {
    return fmt::format("{:.3g}{}{}", magnitude, quantity.unit.empty() ? "" : " ", quantity.unit);
}

std::string rangeText(const ValidRange& range) {
    if (!range.at_original) return "nowhere";
    return rangeOf(range.down.broken ? std::optional(range.down.last) : std::nullopt,
                   range.up.broken ? std::optional(range.up.last) : std::nullopt);
}

std::string rangeText(const Predicted& predicted, const QuantityAudit& audit) {
    if (predicted.because.empty()) return "";
    const double first = audit.steps.front().magnitude, last = audit.steps.back().magnitude;
    const std::string range = rangeOf(predicted.down > first ? std::optional(predicted.down) : std::nullopt,
                                      predicted.up < last ? std::optional(predicted.up) : std::nullopt);
    return predicted.at_most ? "at most " + range : range;
}

std::vector<Block> blocksOf(const QuantityAudit& of) {
    if (!of.lacks.empty()) return {Paragraph{notVaried(of)}};
    const Quantity& quantity = *of.quantity;
    std::vector<Block> blocks{Heading{3, quantity.name},
                              Paragraph{fmt::format("{}; {} to {}, here {}", quantity.what,
                                                    magnitudeText(of.steps.front().magnitude),
                                                    magnitudeText(of.steps.back().magnitude, quantity),
                                                    magnitudeText(of.original, quantity)),
                                        "soft"},
                              {rangesOf(std::span(&of, 1)), Block::terminal},
                              output::Drawing{auditPlot(of, PlotTarget::page)},
                              remarksOn(of)};
    for (const Failure& failure : of.failures) {
        output::List list{{failure.text}, "how again"};
        if (!failure.command.empty()) list.items.emplace_back(Span(failure.command, Span::command));
        blocks.emplace_back(list);
    }
    return blocks;
}

std::vector<Block> closingOf(const Audit& audit) {
    std::vector<Block> blocks;
    for (const Requirement& requirement : audit.requirements)
        blocks.emplace_back(Paragraph{fmt::format("{}: {} as far as {}{}", requirement.met ? "pass" : "FAIL",
                                                  requirement.quantity, magnitudeText(requirement.magnitude),
                                                  requirement.met ? "" : ": " + requirement.because)});
    return blocks;
}

output::Table stepTable(const Audit& audit) {
    output::Table table;
    for (const char* title : {"quantity", "magnitude", "unit", "path", "settings", "error", "light", "depth",
                              "flip", "misplaced", "nonfinite", "failed"})
        table.columns.push_back({title});
    const auto digits = [](double value) { return fmt::format("{:.9g}", value); };
    for (const QuantityAudit& of : audit.quantities)
        for (const Step& step : of.steps)
            for (std::size_t s = 0; s < of.series.size(); ++s) {
                const Outcome& outcome = step.outcomes[s];
                std::vector<std::string> changes;
                for (const Change& change : of.series[s].changes)
                    changes.push_back(fmt::format("{}={}", change.option, change.value));
                table.rows.push_back(
                    {{of.quantity->name, digits(step.magnitude), of.quantity->unit, nameOf(of.series[s].path),
                      fmt::format("{}", fmt::join(changes, " ")), digits(outcome.error()),
                      digits(outcome[Measure::light_p99]), digits(outcome[Measure::depth_p99]),
                      digits(outcome[Measure::flip]),
                      std::to_string(outcome.whole(Measure::material_mismatch_pixels)),
                      std::to_string(outcome.whole(Measure::nonfinite_pixels)), outcome.failed}});
            }
    return table;
}

std::string writeAudit(const Audit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, auditManifest, force);
    std::vector<const experiment::Row*> rows;
    for (const QuantityAudit& quantity : audit.quantities) {
        for (const Step& step : quantity.steps)
            for (const Outcome& outcome : step.outcomes) rows.push_back(&outcome);
        if (!quantity.steps.empty())
            folder.put(std::string(quantity.quantity->name) + ".svg", auditPlot(quantity, PlotTarget::file));
    }
    folder.put("audit.csv", inCsv(stepTable(audit)));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(rows)));
    for (const auto& [name, text] : audit.scenes) folder.put(name, text);
    folder.put("index.html", auditHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
