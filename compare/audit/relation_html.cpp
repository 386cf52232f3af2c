// SPDX-License-Identifier: MIT
#include "compare/audit/words.h"
#include "compare/files/listed_folder.h"
#include "compare/metrics/channel.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/picture/picture.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/png.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

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

// Broken relations come first.
std::vector<const RelationResult*> ordered(const RelationAudit& audit) {
    std::vector<const RelationResult*> all;
    for (const char* verdict : {"broken", "holds", "does not apply"})
        for (const RelationResult& of : audit.relations)
            if (verdictOf(of) == verdict) all.push_back(&of);
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
            const std::string_view name = of->relation->name;
            const std::uint64_t aside = series.comparison.aside + series.comparison.filtered;
            table.rows.push_back({{Span(name, Span::link, fmt::format("#{}", name)), chip(verdictOf(series)),
                                   seriesText(series.series, seriesInWords(series)),
                                   output::numberCell(series.comparison.used()), worstInWords(series),
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
        list.items.push_back(
            seriesText(series.series,
                       seriesInWords(series) + ": " +
                           (series.lacks.empty() ? "allowed: " + series.tolerance.inWords() : series.lacks)));
    box.blocks.emplace_back(output::Box{"soft small", {list}});
    for (const SeriesResult& series : of.series)
        if (series.lacks.empty() && !series.comparison.passes())
            box.blocks.insert(box.blocks.end(), {Paragraph{seriesText(series.series, seriesInWords(series))},
                                                 channelsOf(series), picturesOf(of, series)});
    return box;
}

// lit with the original image's exposure.
Image8 shownLit(const Frame& frame, const Frame& given) {
    const DebugMode& mode = debugMode(Channel::lit);
    PictureScale scale;
    scale.exposure = exposureFor({}, &given.channels.at(mode.channel), coverage(given, given));
    return channelPicture(mode, frame, scale);
}

void putPictures(ListedFolder& folder, const std::string& stem, const SeriesResult& of) {
    const auto put = [&](const char* name, const Image8& picture) {
        const std::string file = fmt::format("{}-{}.png", stem, name);
        folder.list(file);
        writePng(folder / file, picture);
    };
    put("given", shownLit(*of.given, *of.given));
    put("changed", shownLit(*of.changed, *of.given));
    put("used", errorPicture(of.comparison.used_by_pixel, 1));
}

}  // namespace

std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files) {
    output::Box sections{"audit alone", {}};
    for (const RelationResult* of : ordered(audit))
        sections.blocks.emplace_back(sectionOfRelation(*of, audit.device));
    return pageOf(
        audit, "relations", "changes that must not change the picture", audit.passes(),
        {output::Box{"box says", {Paragraph{inWords(audit)}}}, Heading{2, "All verdicts"},
         tableOfRelations(audit),
         Paragraph{
             "Each relation compares two pictures of one renderer, so it needs no ground truth. A "
             "pixel's error is divided by the error allowed there: above 1 the relation is broken. "
             "Pixels at an edge that show another surface are excluded, and so are textured pixels that "
             "a filter weights differently; the number of both is limited.",
             "soft small"},
         Heading{2, "The relations"}, sections},
        files);
}

std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, relationsManifest, force);
    for (const RelationResult& of : audit.relations)
        for (const SeriesResult& series : of.series)
            if (series.changed) putPictures(folder, pictureStem(*of.relation, series), series);
    folder.put("index.html", relationsHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
