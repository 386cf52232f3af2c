// SPDX-License-Identifier: MIT
#include "compare/audit/page/page.h"
#include "compare/audit/plot.h"
#include "compare/audit/words.h"
#include "compare/audit/write.h"
#include "compare/page/page.h"
#include "compare/page/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace diptych::audit {

using page::markup;

namespace {

std::string swatchOf(const Series& series) {
    return fmt::format("<i class=\"swatch {}\"></i>", nameOf(series.path));
}

std::string headOf(const std::vector<std::string>& names) {
    std::string out = "<thead><tr>";
    for (const std::string& name : names)
        out += fmt::format("<th><button type=\"button\">{}</button></th>", markup(name));
    return out + "</tr></thead>\n";
}

// The range that every series of every quantity meets.
std::string tableOf(const Audit& audit) {
    std::vector<std::string> names{"quantity", "settings"};
    for (const Criterion& criterion : criteria) names.emplace_back(criterion.title);
    names.insert(names.end(), {"predicted, 1e-3", "predicted, 1e-2", "agree"});
    std::string out = "<div class=\"box scroll rows\"><table class=\"stack\">" + headOf(names) + "<tbody>";
    for (const QuantityAudit& of : audit.quantities) {
        if (!of.lacks.empty()) continue;
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            out += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}{2}</td>", of.quantity->name,
                               swatchOf(of.series[s]), markup(of.series[s].words()));
            for (std::size_t c = 0; c < criterionCount; ++c) {
                const ValidRange& range = of.valid_ranges[c][s];
                const bool whole = range.at_original && !range.up.broken && !range.down.broken;
                out += fmt::format("<td{}>{}</td>", whole ? "" : " class=\"broken\"",
                                   markup(rangeInWords(range)));
            }
            std::optional<bool> agree;
            for (std::size_t c = 0; c < of.predicted.size(); ++c) {
                out += fmt::format("<td title=\"{}\">{}</td>", markup(of.predicted[c][s].because),
                                   markup(rangeInWords(of.predicted[c][s], of)));
                if (const auto one = agrees(of, c, s)) agree = agree.value_or(true) && *one;
            }
            out += fmt::format("<td>{}</td></tr>\n", !agree ? "" : *agree ? "yes" : "no");
        }
    }
    return out + "</tbody></table></div>\n";
}

std::string stepsOf(const QuantityAudit& of) {
    std::string out =
        "<details><summary>Every step</summary><div class=\"scroll rows\"><table class=\"stack\">" +
        headOf({"magnitude", "settings", "light", "depth", "FLIP", "misplaced", "NaN or infinite"}) +
        "<tbody>";
    for (const Step& step : of.steps)
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            const Outcome& outcome = step.outcomes[s];
            out += "<tr>" + page::numberCell(step.magnitude, magnitudeInWords(step.magnitude)) +
                   fmt::format("<td>{}{}{}</td>", swatchOf(of.series[s]), markup(of.series[s].words()),
                               outcome.failed.empty() ? "" : ": " + markup(outcome.failed));
            for (const double value : {outcome.light, outcome.depth, outcome.flip})
                out += page::numberCell(value, page::number(value));
            for (const std::uint64_t count : {outcome.misplaced, outcome.nonfinite})
                out += page::numberCell(static_cast<double>(count), std::to_string(count));
            out += "</tr>\n";
        }
    return out + "</tbody></table></div></details>";
}

std::string sectionOf(const QuantityAudit& of) {
    const Quantity& quantity = *of.quantity;
    std::string out =
        fmt::format("<div class=\"box\" id=\"{0}\"><h3>{0}</h3><p class=\"soft\">{1}; here {2} {3}</p>",
                    quantity.name, markup(quantity.what), magnitudeInWords(of.original), quantity.unit);
    out += auditPlot(of, PlotPlace::page);
    std::vector<std::string> reasons;
    for (const std::vector<Predicted>& predicted : of.predicted)
        for (const Predicted& one : predicted)
            if (!one.because.empty() && std::ranges::count(reasons, one.because) == 0)
                reasons.push_back(one.because);
    for (const std::string& reason : reasons)
        out += fmt::format("<p class=\"soft small\">Predicted: {}</p>", markup(reason));
    for (const std::string& left : of.left_out)
        out += fmt::format("<p class=\"soft small\">No series of its own: {}</p>", markup(left));
    for (const Failure& failure : of.failures)
        out += fmt::format(
            "<p class=\"again\">{}<code>{}</code><button type=\"button\" data-do=\"copy\">copy"
            "</button></p>",
            markup(failure.words), markup(failure.command));
    return out + stepsOf(of) + "</div>\n";
}

}  // namespace

std::string auditHtml(const Audit& audit, const std::vector<std::string>& files) {
    const bool failed = std::ranges::any_of(audit.requirements, [](const Requirement& r) { return !r.met; });
    std::string verdict;
    if (!audit.requirements.empty())
        verdict = fmt::format("<span class=\"verdict {0}\">{0}</span> ", failed ? "fail" : "pass");
    std::string out = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: an audit, "
        "{}</title>\n<style>{}{}{}</style></head>\n<body>\n<header><p "
        "class=\"brand\">Diptych</p><h1>{}{}</h1><p class=\"soft\">where each path breaks, varying one "
        "quantity at a time; {}x{} on {} ({}); {}</p></header>\n",
        markup(audit.scene), page::style, plotStyle, auditStyle, verdict, page::breakable(audit.scene),
        audit.settings.size.width, audit.settings.size.height, markup(audit.device.name),
        markup(audit.device.driver), page::isolated(audit.camera));
    if (!audit.requirements.empty()) {
        out += "<div class=\"box says\"><ul>";
        for (const Requirement& requirement : audit.requirements)
            out += "<li>" + markup(inWords(requirement)) + "</li>";
        out += "</ul></div>\n";
    }
    out += "<h2>Range in which each path holds</h2>\n" + tableOf(audit);
    out +=
        "<p class=\"soft small\">The error is the larger of two 99th percentiles over the pixels that show a "
        "surface: of lit against a double-precision reference that shades the surfaces forward+ captures, "
        "and of view depth against rays traced in double precision. Predictions say how far float32 and "
        "double should hold if Settings add no other rounding. A prediction agrees with a measurement within "
        "a factor of 2.</p>\n<h2>Error by magnitude</h2>\n<div class=\"audit\">";
    for (const QuantityAudit& of : audit.quantities)
        if (of.lacks.empty()) out += sectionOf(of);
    out += "</div>\n";
    std::vector<std::string> notes = audit.notes;
    if (!audit.to_come.empty())
        notes.push_back(fmt::format("still being measured: {}", fmt::join(audit.to_come, ", ")));
    for (const QuantityAudit& of : audit.quantities)
        if (!of.lacks.empty())
            notes.push_back(fmt::format("{} was not varied: {}", of.quantity->name, of.lacks));
    if (!notes.empty()) {
        out += "<h3 class=\"part\">Notes</h3><div class=\"box says\"><ul>";
        for (const std::string& note : notes) out += "<li>" + markup(note) + "</li>";
        out += "</ul></div>\n";
    }
    out += "<footer><p>";
    for (const std::string& file : files) out += fmt::format("<a href=\"{0}\">{0}</a> ", file);
    return out + fmt::format("</p></footer><script>{}{}{}</script>\n</body></html>\n", page::tables,
                             page::copying, auditScript);
}

}  // namespace diptych::audit
