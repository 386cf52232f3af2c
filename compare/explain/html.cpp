// SPDX-License-Identifier: MIT
#include "compare/explain/html.h"

#include "compare/explain/pictures.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace diptych {

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

std::string table(const Explanation& e) {
    const bool sampled = std::ranges::any_of(e.causes, [](const Cause& c) { return c.interval > 0; });
    const bool lights = std::ranges::any_of(e.causes, [](const Cause& c) { return !c.lights.empty(); });
    std::string out = fmt::format(
        "<div class=\"box scroll\"><table class=\"stack\"><thead><tr><th>cause</th><th "
        "class=\"n\">share</th>{}<th class=\"n\">of FLIP</th><th class=\"n\">alone</th><th "
        "class=\"n\">last</th><th class=\"n\">largest at</th><th class=\"n\">worst pixel</th><th "
        "class=\"n\">there</th><th>materials</th>{}</tr></thead>\n<tbody>",
        sampled ? "<th class=\"n\">95 % interval</th>" : "", lights ? "<th>lights</th>" : "");
    for (std::size_t i = 0; i < e.causes.size(); ++i) {
        const Cause& cause = e.causes[i];
        out += fmt::format("<tr><td>{}{}</td>{}", swatch(i), markup(cause.name),
                           page::numberCell(cause.share, percentOf(e, cause.share)));
        if (sampled)
            out += page::numberCell(cause.interval, fmt::format("{:.2f} %", 100 * e.shareOf(cause.interval)));
        out += page::numberCell(cause.flip, fmt::format("{:.2f} %", 100 * e.shareOfFlip(cause.flip))) +
               page::numberCell(cause.alone, percentOf(e, cause.alone)) +
               page::numberCell(cause.last, percentOf(e, cause.last)) +
               page::numberCell(dominatedShare(e, i), fmt::format("{:.1f} %", 100 * dominatedShare(e, i)));
        out += fmt::format("<td class=\"n\">{},{}</td>{}<td class=\"whole\">{}</td>", cause.worst_x,
                           cause.worst_y, page::numberCell(cause.worst, number(cause.worst)),
                           markup(partsOf(cause, cause.materials, materialName)));
        if (lights)
            out +=
                fmt::format("<td class=\"whole\">{}</td>", markup(partsOf(cause, cause.lights, lightName)));
        out += "</tr>\n";
    }
    return out +
           fmt::format(
               "</tbody></table><p class=\"soft small\">Shares are Shapley values: the part of the "
               "mean lit difference that swapping the cause removes, averaged over all orders of "
               "swapping. Shares and the unexplained part add up to 100 %. Of FLIP: the same for the mean of "
               "HDR-FLIP. Alone: only this cause is swapped; last: it is swapped after all others. Largest "
               "at: share of the affected pixels where this cause is the largest. There: its share at "
               "its worst pixel, W/(sr m^2).</p></div>\n");
}

std::string remarks(const Explanation& e, const ExplainedPictures& of) {
    std::vector<std::string> lines;
    for (const CausePair& pair : e.pairs) lines.push_back(pairLine(e, pair));
    if (e.shareOf(e.unexplained) > worthUnexplained)
        lines.emplace_back(
            "With every cause swapped, lit still differs: the rest comes from something that no channel and "
            "no Setting describes");
    if (!e.without_effect.empty())
        lines.push_back(
            fmt::format("Differs without an effect on any pixel: {}", fmt::join(e.without_effect, ", ")));
    if (const std::string line = reproductionLine(e, of); !line.empty()) lines.push_back(line);
    if (const std::string line = lightsLine(e); !line.empty()) lines.push_back(line);
    if (e.nonfinite > 0)
        lines.push_back(fmt::format("excluded: {} with NaN or infinity in one of the pictures",
                                    counted(e.nonfinite, "pixel")));
    lines.push_back(fmt::format("FLIP is {} on average, {} with all causes swapped; {} shaded from {}",
                                number(e.flip), number(e.flip_unexplained),
                                counted(static_cast<std::uint64_t>(e.subsets), "picture"),
                                counted(static_cast<std::uint64_t>(e.frames), "rendered frame")));
    std::string out = "<div class=\"box says\"><ul>";
    for (const std::string& line : lines) out += "<li>" + markup(line) + "</li>";
    return out + "</ul></div>\n";
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

std::string commands(const ExplainedPictures& of) {
    std::string out;
    for (const ExplainedPictures::Command& command : of.commands)
        out += fmt::format("<p class=\"again\">{} <code>{}</code></p>", markup(command.does),
                           markup(command.line));
    return out.empty() ? out : "<h2>Commands</h2>\n<div class=\"box\">" + out + "</div>\n";
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
        return out + "<p class=\"equal\">no cause: no difference has an effect on lit</p>" + remarks(e, of) +
               "</section>\n";
    const std::string map = figure(
        source(dominantFile), "the largest cause at each pixel",
        "The largest cause at each pixel; dark: the picture itself, where no cause reduces the difference");
    out += map.empty() ? "<div class=\"box\">" + legend(e) + "</div>"
                       : "<div class=\"box pictures\">" + map + legend(e) + "</div>";
    return out + table(e) + remarks(e, of) + shareMaps(e, source) + "</section>\n";
}

std::string explanationHtml(const Explanation& e, const ExplainedPictures& of, const std::string& device) {
    std::string pictures =
        "<h2>The pictures</h2>\n<div class=\"maps\">" +
        figure(litFiles[0], "lit of the baseline", markup(of.baseline) + ", the baseline") +
        figure(litFiles[1], "lit of the test", markup(of.test));
    if (e.distance > 0)
        pictures += figure(
            differenceFile, "their difference",
            fmt::format("Difference: black 0, pale yellow {} W/(sr m^2), cyan beyond", number(topOfMaps(e))));
    pictures += "</div>\n";
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: why lit differs, "
        "{0}</title>\n<style>{1}</style></head>\n<body>\n<header><p "
        "class=\"brand\">Diptych</p><h1>{0}</h1><p class=\"soft\">{2} against {3}, {4}\u00d7{5}, on "
        "{6}</p></header>\n{7}{8}{9}<footer><p><a "
        "href=\"explain.json\">explain.json</a></p></footer><script>{10}</script>\n</body></html>\n",
        markup(of.scene), page::style, page::isolated(of.test), page::isolated(of.baseline), e.dominant.width,
        e.dominant.height, markup(device),
        explanationSection(e, of, [](const std::string& name) { return name; }), pictures, commands(of),
        page::tables);
}

}  // namespace diptych
