// SPDX-License-Identifier: MIT
#include "compare/explain/html.h"

#include "compare/explain/pictures.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace diptych {

using output::Span;
using page::markup;
using page::number;

namespace {

constexpr double shownPart = 0.05;  // of a cause's share: minimum for materials, lights
constexpr std::size_t shownParts = 5;

std::string percentOf(const Explanation& e, double share) {
    return fmt::format("{:.2f} %", 100 * e.shareOf(share));
}

std::string swatch(std::size_t place) {
    return fmt::format("<i class=\"swatch\" style=\"background:{}\"></i>", cssColor(causeColor(place)));
}

// A bar for a share, relative to the largest one.
std::string bar(const Explanation& e, double share, const std::string& color) {
    double largest = e.unexplained;
    for (const Cause& cause : e.causes) largest = std::max(largest, std::abs(cause.share));
    return fmt::format("<span class=\"meter\"><i style=\"width:{:.1f}%;background:{}\"></i></span>",
                       largest > 0 ? 100 * std::abs(share) / largest : 0.0, color);
}

std::string legend(const Explanation& e) {
    std::string out = "<ul class=\"causes\">";
    for (std::size_t i = 0; i < e.causes.size(); ++i)
        out += fmt::format("<li>{}<b>{}</b> {} <span class=\"soft\">{}</span>{}</li>", swatch(i),
                           markup(e.causes[i].name), percentOf(e, e.causes[i].share),
                           markup(e.causes[i].shows), bar(e, e.causes[i].share, cssColor(causeColor(i))));
    out += fmt::format(
        "<li><b>unexplained</b> {} <span class=\"soft\">remains with all causes swapped</span>{}</li>",
        percentOf(e, e.unexplained), bar(e, e.unexplained, "var(--soft)"));
    if (e.causes.size() > ownColors + 1)
        out += "<li class=\"soft\">pale grey: any of the causes with that colour</li>";
    return out + "</ul>";
}

std::string figure(const std::string& source, const std::string& alt, const std::string& caption) {
    return source.empty() ? std::string()
                          : fmt::format(
                                "<figure><img loading=\"lazy\" src=\"{}\" "
                                "alt=\"{}\"><figcaption>{}</figcaption></figure>",
                                markup(source), markup(alt), caption);
}

std::string partsOf(const Cause& cause, const auto& parts, const auto& nameOf) {
    std::string out;
    for (std::size_t i = 0; cause.share != 0 && i < std::min(shownParts, parts.size()); ++i) {
        const double share = parts[i].share / cause.share;
        if (share < shownPart) break;
        out += fmt::format("{}{:.0f} % {}", i == 0 ? "" : "; ", 100 * share, nameOf(parts[i]));
    }
    return out;
}

output::Table table(const Explanation& e) {
    using output::Column;
    output::Table table{
        .columns = {},
        .box = "box scroll",
        .note =
            "Shares are Shapley values: the part of the mean lit difference that swapping the cause "
            "removes, averaged over all orders of swapping. Shares and the unexplained part add up to "
            "100 %. For FLIP: the same for the mean of HDR-FLIP. Alone: only this cause is swapped; last: "
            "it is swapped after all others. Largest at: share of the affected pixels where this cause "
            "is the largest. There: its share at its worst pixel, W/(sr m^2)."};
    const auto add = [&](const char* title, Column::Kind kind, const auto& cellOf) {
        addColumn(table, {title, kind}, e.causes, cellOf);
    };
    const auto addShare = [&](const char* title, double Cause::*share) {
        add(title, Column::number,
            [&](const Cause& cause) { return output::sorted(cause.*share, percentOf(e, cause.*share)); });
    };
    const auto placeOf = [&](const Cause& cause) {
        return static_cast<std::size_t>(&cause - e.causes.data());
    };
    add("cause", Column::words, [&](const Cause& cause) {
        return output::Text{Span(swatch(placeOf(cause)), Span::drawn), cause.name};
    });
    addShare("share", &Cause::share);
    if (std::ranges::any_of(e.causes, [](const Cause& cause) { return cause.interval > 0; }))
        addShare("95 % interval", &Cause::interval);
    add("of FLIP", Column::number, [&](const Cause& cause) {
        return output::sorted(cause.flip, fmt::format("{:.2f} %", 100 * e.shareOfFlip(cause.flip)));
    });
    addShare("alone", &Cause::alone);
    addShare("last", &Cause::last);
    add("largest at", Column::number, [&](const Cause& cause) {
        const double share = dominatedShare(e, placeOf(cause));
        return output::sorted(share, fmt::format("{:.1f} %", 100 * share));
    });
    add("worst pixel", Column::number,
        [](const Cause& cause) { return fmt::format("{},{}", cause.worst_x, cause.worst_y); });
    add("there", Column::number, [](const Cause& cause) { return output::numberCell(cause.worst); });
    add("materials", Column::prose,
        [](const Cause& cause) { return partsOf(cause, cause.materials, materialName); });
    if (std::ranges::any_of(e.causes, [](const Cause& cause) { return !cause.lights.empty(); }))
        add("lights", Column::prose,
            [](const Cause& cause) { return partsOf(cause, cause.lights, lightName); });
    return table;
}

output::List remarks(const Explanation& e, const ExplainedPictures& of) {
    output::List list{{}, "box says"};
    const auto add = [&](const std::string& line) {
        if (!line.empty()) list.items.emplace_back(line);
    };
    for (const CausePair& pair : e.pairs) add(pairLine(e, pair));
    if (e.shareOf(e.unexplained) > worthUnexplained)
        add("With every cause swapped, lit still differs: the rest comes from something that no channel and "
            "no Setting describes");
    if (!e.without_effect.empty())
        add(fmt::format("Differs without an effect on any pixel: {}", fmt::join(e.without_effect, ", ")));
    add(reproductionLine(e, of));
    add(lightsLine(e));
    if (e.nonfinite > 0)
        add(fmt::format("excluded: {} with NaN or infinity in one of the pictures",
                        counted(e.nonfinite, "pixel")));
    add(fmt::format("FLIP is {} on average, {} with all causes swapped; {} shaded from {}", number(e.flip),
                    number(e.flip_unexplained), counted(static_cast<std::uint64_t>(e.subsets), "picture"),
                    counted(static_cast<std::uint64_t>(e.frames), "rendered frame")));
    return list;
}

std::string shareMaps(const Explanation& e, const PictureSource& source) {
    std::string out;
    for (std::size_t i = 0; i < e.causes.size(); ++i)
        out += figure(source(shareFile(e, i)), "share of " + e.causes[i].name,
                      fmt::format("<span>{}{}</span><span>{}</span>", swatch(i), markup(e.causes[i].name),
                                  percentOf(e, e.causes[i].share)));
    if (!out.empty() && e.unexplained > 0)
        out += figure(source(unexplainedFile), "the unexplained part",
                      fmt::format("<span>unexplained</span><span>{}</span>", percentOf(e, e.unexplained)));
    if (out.empty()) return {};
    return fmt::format(
        "<h2>Each cause alone</h2>\n<p class=\"soft\">Each cause's share of the difference at each pixel, "
        "all on one scale: black 0, pale yellow {} W/(sr m^2), cyan beyond; green where it cancels "
        "others.</p><div class=\"maps\">{}</div>\n",
        number(topOfMaps(e)), out);
}

std::string difference(const Explanation& e) {
    return fmt::format("{} W/(sr m^2) on average, FLIP {}", number(e.distance), number(e.flip));
}

}  // namespace

std::string explanationSection(const Explanation& e, const ExplainedPictures& of,
                               const PictureSource& source) {
    std::string out = "<section class=\"explained\">";
    if (e.distance == 0) return out + "<p class=\"equal\">no cause: lit is the same</p></section>\n";
    out +=
        fmt::format("<h2>Why lit differs</h2>\n<p class=\"soft\">lit of {} differs from that of {} by {}</p>",
                    markup(of.test), markup(of.baseline), difference(e));
    if (e.causes.empty())
        return out + "<p class=\"equal\">no cause: no difference has an effect on lit</p>" +
               inHtml(remarks(e, of)) + "</section>\n";
    const std::string map = figure(
        source(dominantFile), "the largest cause at each pixel",
        "The largest cause at each pixel; dark: the picture itself, where no cause reduces the difference");
    out += map.empty() ? "<div class=\"box\">" + legend(e) + "</div>"
                       : "<div class=\"box pictures\">" + map + legend(e) + "</div>";
    return out + inHtml(table(e)) + inHtml(remarks(e, of)) + shareMaps(e, source) + "</section>\n";
}

std::string explanationHtml(const Explanation& e, const ExplainedPictures& of) {
    std::string pictures =
        "<h2>The pictures</h2>\n<div class=\"maps\">" +
        figure(litFiles[0], "lit of the baseline", markup(of.baseline) + ", the baseline") +
        figure(litFiles[1], "lit of the test", markup(of.test));
    if (e.distance > 0)
        pictures += figure(
            differenceFile, "their difference",
            fmt::format("Difference: black 0, pale yellow {} W/(sr m^2), cyan beyond", number(topOfMaps(e))));
    pictures += "</div>\n";
    output::Document page{
        .title = "why lit differs, " + of.scene,
        .heading = of.scene,
        .about = {Span(of.test, Span::foreign), " against ", Span(of.baseline, Span::foreign),
                  fmt::format(", {}\u00d7{}, on {}", e.dominant.width, e.dominant.height, of.device)},
        .blocks = {output::Drawing{explanationSection(e, of, [](const std::string& name) { return name; }) +
                                   pictures}},
        .files = {"explain.json"}};
    output::Box commands{"box", {}};
    for (const ExplainedPictures::Command& command : of.commands)
        commands.blocks.emplace_back(
            output::Paragraph{{command.does + " ", Span(command.line, Span::command)}, "again"});
    if (!of.commands.empty())
        page.blocks.insert(page.blocks.end(), {output::Heading{2, "Commands"}, commands});
    return inHtml(page);
}

}  // namespace diptych
