// SPDX-License-Identifier: MIT
#include "compare/audit/page.h"
#include "compare/audit/relation_words.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/frame/debug_modes.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::audit {

using output::Column;
using output::Heading;
using output::Paragraph;
using output::Span;

namespace {

Span chip(std::string_view verdict) {
    if (verdict == "does not apply") return {verdict, Span::words, "soft"};
    return {verdict, Span::verdict, verdict == "holds" ? "pass" : "fail"};
}

output::Text seriesText(const SeriesResult& of, const std::string& after = "") {
    return {Span("", Span::swatch, nameOf(of.series.path)), seriesInWords(of) + after};
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

output::Table tableOfRelations(const RelationAudit& audit) {
    output::Table table{{{"relation"},
                         {"verdict"},
                         {"renderer"},
                         {"error / allowed", Column::number},
                         {"worst pixel"},
                         {"set aside", Column::number}},
                        {},
                        true};
    for (const RelationResult* of : ordered(audit))
        for (const SeriesResult& series : of->series) {
            if (!series.lacks.empty()) continue;
            const ChannelResult* const worst = series.comparison.worst();
            const std::string_view name = of->relation->name;
            const std::uint64_t aside = series.comparison.aside + series.comparison.filtered;
            table.rows.push_back(
                {{Span(name, Span::link, fmt::format("#{}", name)), chip(verdictOf(series)),
                  seriesText(series), output::numberCell(worst ? worst->used : 0), worstInWords(series),
                  output::sorted(static_cast<double>(aside), std::to_string(aside))}});
        }
    return table;
}

output::Drawing picturesOf(const RelationResult& of, const SeriesResult& series) {
    if (!series.changed) return {};
    std::string out = "<div class=\"related\">";
    for (const auto& [name, words] :
         {std::pair{"given", "original"}, {"changed", "changed"}, {"used", "error / allowed"}})
        out += fmt::format(
            "<figure><img src=\"{0}-{1}.png\" alt=\"{2}\"><figcaption>{2}, {3}</figcaption></figure>",
            pictureStem(*of.relation, series), name, words, page::markup(series.series.words()));
    return {out + "</div>"};
}

output::List channelsOf(const SeriesResult& series) {
    const FrameResult& comparison = series.comparison;
    output::List list;
    for (const ChannelResult& channel : comparison.channels)
        if (channel.beyond > 0)
            list.items.emplace_back(
                fmt::format("{}: {} out of tolerance; the worst at {},{}: error {}, allowed {}",
                            debugMode(channel.mode).name, counted(channel.beyond, "pixel"), channel.x,
                            channel.y, page::number(channel.error), page::number(channel.allowed)));
    if (comparison.aside > comparison.most_aside)
        list.items.emplace_back(fmt::format("{} show another surface; at most {} may",
                                            counted(comparison.aside, "pixel"), comparison.most_aside));
    if (comparison.filtered > comparison.most_filtered)
        list.items.emplace_back(fmt::format("{} filter a texture differently; at most {} may",
                                            counted(comparison.filtered, "pixel"), comparison.most_filtered));
    if (!comparison.failed.empty()) list.items.emplace_back("not drawn: " + comparison.failed);
    return list;
}

output::Box sectionOfRelation(const RelationResult& of, const ReportDevice& device) {
    const Relation& relation = *of.relation;
    output::Box box{"box",
                    {Heading{3, {Span(relation.name, Span::name), " ", chip(verdictOf(of))}},
                     Paragraph{fmt::format("{}.", relation.changes)},
                     Paragraph{fmt::format("{}.", relation.because), "soft small"}},
                    std::string(relation.name)};
    if (!of.lacks.empty()) box.blocks.emplace_back(Paragraph{of.lacks, "soft"});
    if (const std::string blame = blameInWords(of, device); !blame.empty())
        box.blocks.emplace_back(Paragraph{Span(blame + ".", Span::strong)});
    output::List list;
    for (const SeriesResult& series : of.series)
        list.items.push_back(seriesText(
            series, ": " + (series.lacks.empty() ? "allowed: " + series.tolerance.inWords() : series.lacks)));
    box.blocks.emplace_back(output::Box{"soft small", {list}});
    for (const SeriesResult& series : of.series)
        if (series.lacks.empty() && !series.comparison.passes())
            box.blocks.insert(box.blocks.end(),
                              {Paragraph{seriesText(series)}, channelsOf(series), picturesOf(of, series)});
    return box;
}

}  // namespace

std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files) {
    output::Document page =
        pageOf(audit, "relations", "changes that must not change the picture", files, audit.passes());
    output::Box sections{"audit alone", {}};
    for (const RelationResult* of : ordered(audit))
        sections.blocks.emplace_back(sectionOfRelation(*of, audit.device));
    page.blocks = {
        output::Box{"box says", {Paragraph{inWords(audit)}}},
        Heading{2, "All verdicts"},
        tableOfRelations(audit),
        Paragraph{"Each relation compares two pictures of one renderer, so it needs no ground truth. A "
                  "pixel's error is divided by the error allowed there: above 1 the relation is broken. "
                  "Pixels at an edge that show another surface are excluded, and so are textured pixels that "
                  "a filter weights differently; the number of both is limited.",
                  "soft small"},
        Heading{2, "The relations"},
        sections};
    addNotes(page, audit.notes);
    return inHtml(page);
}

}  // namespace diptych::audit
