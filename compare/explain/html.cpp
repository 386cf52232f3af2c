// SPDX-License-Identifier: MIT
#include "compare/explain/pictures.h"
#include "compare/explain/write.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych {

using output::Span;
using page::markup;
using page::number;

namespace {

constexpr double shownPart = 0.05;  // of a cause's share: minimum for materials, lights
constexpr std::size_t shownParts = 5;
constexpr const char* litFiles[] = {"lit.baseline.png", "lit.test.png"};

std::string percentOf(const Explanation& e, double share) {
    return fmt::format("{:.2f} %", 100 * e.shareOf(share));
}

// "#56b4e9".
std::string cssColor(std::size_t cause) {
    const Color8 color = causeColor(cause);
    return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string swatch(std::size_t cause) {
    return fmt::format("<i class=\"swatch\" style=\"background:{}\"></i>", cssColor(cause));
}

std::string legend(const Explanation& e) {
    double largest = e.unexplained;
    for (const Cause& cause : e.causes) largest = std::max(largest, std::abs(cause.share));
    std::string out;
    const auto add = [&](const std::string& before, const std::string& name, double share,
                         const std::string& shows, const std::string& color) {
        out += fmt::format(
            "<li>{}<b>{}</b> {} <span class=\"soft\">{}</span><span class=\"meter\"><i "
            "style=\"width:{:.1f}%;background:{}\"></i></span></li>",
            before, markup(name), percentOf(e, share), markup(shows),
            largest > 0 ? 100 * std::abs(share) / largest : 0.0, color);
    };
    for (std::size_t i = 0; i < e.causes.size(); ++i)
        add(swatch(i), e.causes[i].name, e.causes[i].share, e.causes[i].shows, cssColor(i));
    add("", "unexplained", e.unexplained, "remains with all causes swapped", "var(--soft)");
    if (e.causes.size() > ownColors + 1)
        out += "<li class=\"soft\">pale grey: any of the causes with that colour</li>";
    return "<ul class=\"causes\">" + out + "</ul>";
}

std::string figure(const std::string& source, const std::string& alt, const std::string& caption) {
    return source.empty() ? std::string()
                          : fmt::format(
                                "<figure><img loading=\"lazy\" src=\"{}\" "
                                "alt=\"{}\"><figcaption>{}</figcaption></figure>",
                                markup(source), markup(alt), caption);
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
    add("cause", Column::words, [&](const Cause& cause) {
        const auto place = static_cast<std::size_t>(&cause - e.causes.data());
        return output::Text{Span(swatch(place), Span::drawn), cause.name};
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
        return output::sorted(cause.dominates, fmt::format("{:.1f} %", 100 * cause.dominates));
    });
    add("worst pixel", Column::number,
        [](const Cause& cause) { return fmt::format("{},{}", cause.worst_x, cause.worst_y); });
    add("there", Column::number, [](const Cause& cause) { return output::numberCell(cause.worst); });
    add("materials", Column::prose, [](const Cause& cause) {
        return partsOf(cause, cause.materials, "", "material", shownParts, shownPart);
    });
    if (std::ranges::any_of(e.causes, [](const Cause& cause) { return !cause.lights.empty(); }))
        add("lights", Column::prose, [](const Cause& cause) {
            return partsOf(cause, cause.lights, "", "light", shownParts, shownPart);
        });
    return table;
}

output::List remarks(const Explanation& e, const ExplainedPictures& of) {
    output::List list{{}, "box says"};
    const auto add = [&](const std::string& line) { list.items.emplace_back(line); };
    if (e.shareOf(e.unexplained) > worthUnexplained)
        add("With every cause swapped, lit still differs: the rest comes from something that no channel and "
            "no Setting describes");
    std::ranges::for_each(remarksOn(e, of), add);
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
    return out;
}

}  // namespace

std::string explanationSection(const Explanation& e, const ExplainedPictures& of,
                               const PictureSource& source) {
    using namespace output;
    std::vector<Block> blocks;
    if (e.distance == 0) {
        blocks.emplace_back(Paragraph{"no cause: lit is the same", "equal"});
    } else {
        blocks = {
            Heading{2, "Why lit differs"},
            Paragraph{fmt::format("lit of {} differs from that of {} by {} W/(sr m^2) on average, FLIP {}",
                                  of.test, of.baseline, number(e.distance), number(e.flip)),
                      "soft"}};
        if (e.causes.empty()) {
            blocks.emplace_back(Paragraph{"no cause: no difference has an effect on lit", "equal"});
        } else {
            const std::string map = figure(source(dominantFile), "the largest cause at each pixel",
                                           "The largest cause at each pixel; dark: the picture itself, where "
                                           "no cause reduces the difference");
            blocks.emplace_back(Box{map.empty() ? "box" : "box pictures", {Drawing{map + legend(e)}}});
            blocks.emplace_back(table(e));
        }
        blocks.emplace_back(remarks(e, of));
        if (const std::string maps = shareMaps(e, source); !maps.empty())
            blocks.insert(
                blocks.end(),
                {Heading{2, "Each cause alone"},
                 Paragraph{fmt::format("Each cause's share of the difference at each pixel, all on one "
                                       "scale: black 0, pale yellow {} W/(sr m^2), cyan beyond; blue "
                                       "where it cancels others.",
                                       number(topOfMaps(e))),
                           "soft"},
                 Box{"maps", {Drawing{maps}}}});
    }
    return "<section class=\"explained\">" + inHtml(blocks) + "</section>\n";
}

std::string explanationHtml(const Explanation& e, const ExplainedPictures& of) {
    using namespace output;
    std::string pictures =
        figure(litFiles[0], "lit of the baseline", markup(of.baseline) + ", the baseline") +
        figure(litFiles[1], "lit of the test", markup(of.test));
    if (e.distance > 0)
        pictures += figure(
            differenceFile, "their difference",
            fmt::format("Difference: black 0, pale yellow {} W/(sr m^2), cyan beyond", number(topOfMaps(e))));
    Document page{
        .title = "why lit differs, " + of.scene,
        .heading = of.scene,
        .about = {Span(of.test, Span::foreign), " against ", Span(of.baseline, Span::foreign),
                  fmt::format(", {}\u00d7{}, on {}", e.dominant.width, e.dominant.height, of.device)},
        .blocks = {Drawing{explanationSection(e, of, [](const std::string& name) { return name; })},
                   Heading{2, "The pictures"}, Box{"maps", {Drawing{pictures}}}},
        .files = {explanationManifest}};
    Box commands{"box", {}};
    for (const ExplainedPictures::Command& command : of.commands)
        commands.blocks.emplace_back(
            Paragraph{{command.does + " ", Span(command.line, Span::command)}, "again"});
    if (!of.commands.empty()) page.blocks.insert(page.blocks.end(), {Heading{2, "Commands"}, commands});
    return inHtml(page);
}

std::string writeExplanation(const Explanation& explanation, const ExplainedPictures& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, explanationManifest, force);
    std::vector<NamedPicture> pictures = explanationMaps(explanation);
    for (std::size_t side = 0; side < 2; ++side)
        pictures.push_back({litFiles[side], std::move(lit.at(side))});
    pictures.push_back({dominantFile, dominantPicture(explanation, pictures.back().picture)});
    for (const NamedPicture& picture : pictures) folder.list(picture.name);
    tbb::parallel_for(std::size_t{0}, pictures.size(),
                      [&](std::size_t i) { writePng(folder / pictures[i].name, pictures[i].picture); });
    folder.put("index.html", explanationHtml(explanation, of));
    return folder.finish(toJson(explanation, of));
}

}  // namespace diptych
