// SPDX-License-Identifier: MIT
#include "compare/audit/page/page.h"
#include "compare/audit/relation_words.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
#include "shared/frame/debug_modes.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::audit {

using page::breakable;
using page::markup;

namespace {

std::string chip(std::string_view verdict) {
    if (verdict == "does not apply") return "<span class=\"soft\">does not apply</span>";
    return fmt::format("<span class=\"verdict {}\">{}</span>", verdict == "holds" ? "pass" : "fail", verdict);
}

std::string seriesCell(const SeriesResult& of) {
    return fmt::format("<i class=\"swatch {}\"></i>{}", nameOf(of.series.path), markup(seriesInWords(of)));
}

// Broken relations come first.
std::vector<const RelationResult*> ordered(const RelationAudit& audit) {
    std::vector<const RelationResult*> all;
    for (const RelationResult& of : audit.relations) all.push_back(&of);
    const auto rank = [](const RelationResult* of) {
        const std::string_view verdict = verdictOf(*of);
        return verdict == "broken" ? 0 : verdict == "holds" ? 1 : 2;
    };
    std::ranges::stable_sort(all, {}, rank);
    return all;
}

std::string tableOfRelations(const RelationAudit& audit) {
    std::string out = "<div class=\"box scroll rows\"><table class=\"stack\"><thead><tr>";
    for (const char* name :
         {"relation", "verdict", "renderer", "error / allowed", "worst pixel", "set aside"})
        out += fmt::format("<th><button type=\"button\">{}</button></th>", name);
    out += "</tr></thead>\n<tbody>";
    for (const RelationResult* of : ordered(audit))
        for (const SeriesResult& series : of->series) {
            if (!series.lacks.empty()) continue;
            const ChannelResult* const worst = series.comparison.worst();
            const double used = worst ? worst->used : 0;
            out +=
                fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td>", of->relation->name,
                            breakable(of->relation->name), chip(verdictOf(series)), seriesCell(series));
            out += page::numberCell(used, page::number(used)) +
                   fmt::format("<td>{}</td>", markup(worstInWords(series)));
            const std::uint64_t aside = series.comparison.aside + series.comparison.filtered;
            out += page::numberCell(static_cast<double>(aside), std::to_string(aside)) + "</tr>\n";
        }
    return out + "</tbody></table></div>\n";
}

std::string picturesOf(const RelationResult& of, const SeriesResult& series) {
    if (!series.changed) return {};
    std::string out = "<div class=\"related\">";
    for (const auto& [name, words] :
         {std::pair{"given", "original"}, {"changed", "changed"}, {"used", "error / allowed"}})
        out += fmt::format(
            "<figure><img src=\"{0}-{1}.png\" alt=\"{2}\"><figcaption>{2}, {3}</figcaption></figure>",
            pictureStem(*of.relation, series), name, words, markup(series.series.words()));
    return out + "</div>";
}

std::string channelsOf(const SeriesResult& series) {
    std::string out;
    for (const ChannelResult& channel : series.comparison.channels) {
        if (channel.beyond == 0) continue;
        out += fmt::format("<li>{}: {} out of tolerance; the worst at {},{}: error {}, allowed {}</li>",
                           debugMode(channel.mode).name, counted(channel.beyond, "pixel"), channel.x,
                           channel.y, page::number(channel.error), page::number(channel.allowed));
    }
    if (series.comparison.aside > series.comparison.most_aside)
        out += fmt::format("<li>{} show another surface; at most {} may</li>",
                           counted(series.comparison.aside, "pixel"), series.comparison.most_aside);
    if (series.comparison.filtered > series.comparison.most_filtered)
        out += fmt::format("<li>{} filter a texture differently; at most {} may</li>",
                           counted(series.comparison.filtered, "pixel"), series.comparison.most_filtered);
    if (!series.comparison.failed.empty())
        out += "<li>not drawn: " + markup(series.comparison.failed) + "</li>";
    return out.empty() ? "" : "<ul>" + out + "</ul>";
}

std::string sectionOfRelation(const RelationResult& of, const ReportDevice& device) {
    const Relation& relation = *of.relation;
    std::string out = fmt::format(
        "<div class=\"box\" id=\"{0}\"><h3>{1} {2}</h3><p>{3}.</p><p class=\"soft small\">{4}.</p>",
        relation.name, breakable(relation.name), chip(verdictOf(of)), markup(relation.changes),
        markup(relation.because));
    if (!of.lacks.empty()) out += fmt::format("<p class=\"soft\">{}</p>", markup(of.lacks));
    const std::string blame = blameInWords(of, device);
    if (!blame.empty()) out += fmt::format("<p><strong>{}.</strong></p>", markup(blame));
    out += "<ul class=\"soft small\">";
    for (const SeriesResult& series : of.series)
        out += fmt::format(
            "<li>{}: {}</li>", seriesCell(series),
            markup(series.lacks.empty() ? "allowed: " + series.tolerance.inWords() : series.lacks));
    out += "</ul>";
    for (const SeriesResult& series : of.series)
        if (series.lacks.empty() && !series.comparison.passes())
            out +=
                fmt::format("<p>{}</p>{}{}", seriesCell(series), channelsOf(series), picturesOf(of, series));
    return out + "</div>\n";
}

}  // namespace

std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files) {
    std::string out = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: relations, "
        "{}</title>\n<style>{}{}</style></head>\n<body>\n<header><p "
        "class=\"brand\">Diptych</p><h1>{}{}</h1><p class=\"soft\">changes that must not change the picture; "
        "{}x{} on {} ({}); {}</p></header>\n",
        markup(audit.scene), page::style, auditStyle,
        fmt::format("<span class=\"verdict {0}\">{0}</span> ", audit.passes() ? "pass" : "fail"),
        breakable(audit.scene), audit.settings.size.width, audit.settings.size.height,
        markup(audit.device.name), markup(audit.device.driver), page::isolated(audit.camera));
    out += fmt::format("<div class=\"box says\"><p>{}</p></div>\n", markup(inWords(audit)));
    out += "<h2>All verdicts</h2>\n" + tableOfRelations(audit);
    out +=
        "<p class=\"soft small\">Each relation compares two pictures of one renderer, so it needs no ground "
        "truth. A pixel's error is divided by the error allowed there: above 1 the relation is broken. "
        "Pixels at an edge that show another surface are excluded, and so are textured pixels that a filter "
        "weights differently; the number of both is limited.</p>\n<h2>The relations</h2>\n<div class=\"audit "
        "alone\">";
    for (const RelationResult* of : ordered(audit)) out += sectionOfRelation(*of, audit.device);
    out += "</div>\n";
    if (!audit.notes.empty()) {
        out += "<h3 class=\"part\">Notes</h3><div class=\"box says\"><ul>";
        for (const std::string& note : audit.notes) out += "<li>" + markup(note) + "</li>";
        out += "</ul></div>\n";
    }
    out += "<footer><p>";
    for (const std::string& file : files) out += fmt::format("<a href=\"{0}\">{0}</a> ", file);
    return out + fmt::format("</p></footer><script>{}{}{}</script>\n</body></html>\n", page::tables,
                             page::copying, auditScript);
}

}  // namespace diptych::audit
