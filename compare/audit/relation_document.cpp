// SPDX-License-Identifier: MIT
#include "compare/audit/report.h"
#include "compare/files/listed_folder.h"
#include "compare/image/channel_image.h"
#include "compare/metrics/channel.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/png.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace diptych::audit {

using output::Block;
using output::Column;
using output::Heading;
using output::Paragraph;
using output::Span;
using page::number;

namespace {

Span chip(std::string_view verdict) {
    if (verdict == "does not apply") return {verdict, Span::plain, "soft"};
    return {verdict, Span::verdict, verdict == "holds" ? "pass" : "fail"};
}

std::string describeSeries(const SeriesResult& of) {
    return isReference(of.series.path) ? "reference, double precision" : of.series.describe();
}

// "lit 3.1e-08, allowed 2e-07, at 12,30; another surface at 3 pixels (at most 8)".
std::string describeWorst(const SeriesResult& of) {
    const FrameResult& comparison = of.comparison;
    if (!of.lacks.empty()) return of.lacks;
    if (!comparison.failed.empty()) return "not drawn: " + comparison.failed;
    std::string out = "equal";
    if (const ChannelResult* const worst = comparison.worst())
        out = fmt::format("{} {}{}, allowed {}, at {},{}", debugMode(worst->mode).name, number(worst->error),
                          of.tolerance.equality == Equality::bits ? " ULP" : "", number(worst->allowed),
                          worst->x, worst->y);
    if (comparison.excluded > 0)
        out += fmt::format("; another surface at {} (at most {})", counted(comparison.excluded, "pixel"),
                           comparison.max_excluded);
    if (comparison.filtered > 0)
        out += fmt::format("; a texture filtered differently at {} (at most {})",
                           counted(comparison.filtered, "pixel"), comparison.max_filtered);
    return out;
}

// Why a relation does not apply, who is to blame if it is broken, or its worst pixel.
std::string summaryOf(const RelationResult& of, const ReportDevice& device) {
    if (!of.lacks.empty()) return of.lacks;
    if (verdictOf(of) == "does not apply") return "neither path reads the changed input";
    if (!of.passes()) return blameText(of, device);
    const SeriesResult& worst = *std::ranges::max_element(of.series, {}, [](const SeriesResult& one) {
        return one.lacks.empty() && !isReference(one.series.path) ? one.comparison.used() : -1;
    });
    return (worst.comparison.used() > 0 ? worst.series.describe() + ": " : "") + describeWorst(worst);
}

output::Box imagesOf(const RelationResult& of, const SeriesResult& series) {
    output::Box box{"related", {}};
    for (const auto& [shown, words] :
         {std::pair{"given", "original"}, {"changed", "changed"}, {"used", "error / allowed"}})
        box.blocks.emplace_back(output::ImageBlock{imageName(*of.relation, series.series, shown), words,
                                                   fmt::format("{}, {}", words, series.series.describe())});
    return box;
}

// Broken relations come first.
std::vector<const RelationResult*> ordered(const RelationAudit& audit) {
    std::vector<const RelationResult*> all;
    for (const char* verdict : {"broken", "holds", "does not apply"})
        for (const RelationResult& of : audit.relations)
            if (verdictOf(of) == verdict) all.push_back(&of);
    return all;
}

output::Table verdictsOf(const RelationAudit& audit) {
    output::Table table;
    table.sortable = true;
    table.columns = {{"relation"},
                     {"verdict"},
                     {"renderer"},
                     {"error / allowed", Column::number},
                     {"worst pixel", Column::prose}};
    const output::Cell none = output::sorted(-1, "");
    for (const RelationResult* of : ordered(audit)) {
        const Span name(of->relation->name, Span::link, fmt::format("#{}", of->relation->name));
        if (!of->lacks.empty()) table.rows.push_back({{name, chip(verdictOf(*of)), "", none, of->lacks}});
        for (const SeriesResult& series : of->series)
            table.rows.push_back(
                {{name, chip(verdictOf(series)), seriesText(series.series, describeSeries(series)),
                  series.lacks.empty() ? output::numberCell(series.comparison.used()) : none,
                  describeWorst(series)}});
    }
    return table;
}

std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files) {
    output::Box sections{"audit alone", {}};
    for (const RelationResult* of : ordered(audit))
        sections.blocks.emplace_back(
            output::Box{"box", blocksOf(*of, audit.device), std::string(of->relation->name)});
    return pageOf(
        audit, "relations", "changes that must not change the picture", audit.passes(),
        {output::Box{"box says", closingOf(audit)}, Heading{2, "All verdicts"}, verdictsOf(audit),
         Paragraph{
             "Each relation compares two pictures of one renderer, so it needs no ground truth. A "
             "pixel's error is divided by the error allowed there: above 1 the relation is broken. "
             "Pixels at an edge that show another surface are excluded, and so are textured pixels that "
             "a filter weights differently; the number of both is limited.",
             "soft small"},
         Heading{2, "The relations"}, sections},
        files);
}

// lit with the original image's exposure.
Image8 shownLit(const Frame& frame, const Frame& original) {
    const DebugMode& mode = debugMode(Channel::lit);
    ImageScale scale;
    scale.exposure = exposureFor({}, &original.channels.at(mode.channel), coverage(original, original));
    return channelImage(mode, frame, scale);
}

void putImages(ListedFolder& folder, const Relation& relation, const SeriesResult& of) {
    const auto put = [&](const char* shown, const Image8& image) {
        const std::string file = imageName(relation, of.series, shown);
        folder.list(file);
        writePng(folder / file, image);
    };
    put("given", shownLit(*of.original, *of.original));
    put("changed", shownLit(*of.changed, *of.original));
    put("used", errorMap(of.comparison.used_by_pixel, 1));
}

}  // namespace

bool RelationAudit::passes() const {
    return std::ranges::all_of(relations, [](const RelationResult& of) { return of.passes(); });
}

std::string_view verdictOf(const RelationResult& result) {
    if (std::ranges::all_of(result.series, [](const SeriesResult& of) { return !of.lacks.empty(); }))
        return "does not apply";
    return result.passes() ? "holds" : "broken";
}

std::string_view verdictOf(const SeriesResult& result) {
    return !result.lacks.empty() ? "does not apply" : result.comparison.passes() ? "holds" : "broken";
}

std::string blameText(const RelationResult& result, const ReportDevice& device) {
    if (result.passes()) return {};
    for (const SeriesResult& of : result.series)
        if (isReference(of.series.path) && of.lacks.empty() && !of.comparison.passes())
            return "the double-precision reference breaks it too: the changed scene is read differently, or "
                   "the relation does not hold for this scene; most likely a bug of Diptych";
    return device.bitExact()
               ? fmt::format("holds in double precision, and {} is a CPU: most likely a bug of Diptych",
                             device.name)
               : fmt::format("holds in double precision: a bug of the driver or of Diptych, on {} with {}",
                             device.name, device.driver);
}

std::vector<Block> blocksOf(const RelationResult& of, const ReportDevice& device) {
    const Relation& relation = *of.relation;
    const std::string_view verdict = verdictOf(of);
    const std::string summary = summaryOf(of, device);
    const bool broken = verdict == "broken";
    std::vector<Block> blocks{
        {Heading{3, {Span(relation.name, Span::name), " ", chip(verdict)}}, Block::page},
        {Paragraph{fmt::format("{:<19} {}: {}", relation.name, verdict, summary)}, Block::terminal},
        {Paragraph{fmt::format("{}; {}", relation.changes, relation.because)},
         broken ? Block::everywhere : Block::page},
        {Paragraph{Span(summary, broken ? Span::strong : Span::plain), broken ? "" : "soft small"},
         Block::page}};
    for (const SeriesResult& series : of.series) {
        if (!broken || !series.lacks.empty()) continue;
        const std::string name = describeSeries(series);
        const bool holds = series.comparison.passes();
        output::List list{
            {seriesText(series.series,
                        fmt::format("{}: {}: {}{}", name, verdictOf(series), describeWorst(series),
                                    holds ? "" : "; tolerance: " + series.tolerance.describe()))},
            "how small"};
        for (const ChannelResult& channel : series.comparison.channels)
            if (channel.beyond > 0)
                list.items.emplace_back(
                    fmt::format("{}, {}: {} out of tolerance, the worst at {},{}: {}, allowed {}", name,
                                debugMode(channel.mode).name, counted(channel.beyond, "pixel"), channel.x,
                                channel.y, number(channel.error), number(channel.allowed)));
        blocks.emplace_back(list);
        if (series.changed) blocks.emplace_back(imagesOf(of, series));
    }
    return blocks;
}

std::vector<Block> closingOf(const RelationAudit& audit) {
    const auto count = [&](std::string_view verdict) {
        return std::ranges::count(audit.relations, verdict,
                                  [](const RelationResult& of) { return verdictOf(of); });
    };
    return {Paragraph{fmt::format("{}: {} of {} relations hold, {} broken, {} not applicable",
                                  audit.passes() ? "pass" : "FAIL", count("holds"), audit.relations.size(),
                                  count("broken"), count("does not apply"))}};
}

std::string imageName(const Relation& relation, const Series& series, std::string_view shown) {
    std::string stem = fmt::format("{}-{}", relation.name, nameOf(series.path));
    for (const Change& change : series.changes)
        if (change.option == "gbuffer") stem += fmt::format("-{}", change.value);
    return fmt::format("{}-{}.png", stem, shown);
}

std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, relationsManifest, force);
    for (const RelationResult& of : audit.relations)
        for (const SeriesResult& series : of.series)
            if (series.changed) putImages(folder, *of.relation, series);
    folder.put("index.html", relationsHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
