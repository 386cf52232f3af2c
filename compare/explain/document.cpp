// SPDX-License-Identifier: MIT
// An explanation for terminal, page and folder.
#include "compare/explain/images.h"
#include "compare/explain/write.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/verdict/explained.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace diptych {

using output::Block;
using output::Box;
using output::Column;
using output::Heading;
using output::ImageBlock;
using output::Paragraph;
using output::Span;
using page::number;

namespace {

// A row names at most three materials and three lights, each with at least 5 % of the cause's contribution.
constexpr std::size_t maxListedParts = 3;
constexpr double minListedPart = 0.05;
constexpr const char* litFiles[] = {"lit.baseline.png", "lit.test.png"};

std::string percent(double contribution) {
    return fmt::format("{:.2f} %", 100 * contribution);
}

// "78 % material 12, Lantern glass; 9 % background; 60 % light 3, lamp".
std::string partsOf(const Cause& cause) {
    std::vector<std::string> items;
    for (const auto& [parts, noun] : {std::pair{&cause.materials, "material"}, {&cause.lights, "light"}})
        for (const CausePart& part : std::span(*parts).first(std::min(parts->size(), maxListedParts))) {
            const double contribution = cause.contribution != 0 ? part.contribution / cause.contribution : 0;
            if (contribution < minListedPart) break;
            items.push_back(
                fmt::format("{:.0f} % {}{}{}", 100 * contribution,
                            part.index < 0 ? "background" : fmt::format("{} {}", noun, part.index),
                            part.name.empty() ? "" : ", ", part.name));
        }
    return fmt::format("{}", fmt::join(items, "; "));
}

// In the cause's colour.
Span swatch(const Explanation& e, const Cause& cause) {
    const Color8 c = causeColor(static_cast<std::size_t>(&cause - e.causes.data()));
    return {
        fmt::format("<i class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></i>", c[0], c[1], c[2]),
        Span::drawn};
}

// A row for each cause; the last is the unexplained part.
output::Table causeTable(const Explanation& e) {
    output::Table table{
        .columns = {{"cause"},
                    {"share", Column::number},
                    {"of FLIP", Column::number},
                    {"alone", Column::number, 0, Column::page},
                    {"last", Column::number, 0, Column::page},
                    {"largest at", Column::number},
                    {"worst pixel", Column::number},
                    {"there", Column::number, 0, Column::page},
                    {"description", Column::prose, 0, Column::page},
                    {"materials and lights", Column::prose}},
        .box = "box scroll",
        .note =
            "Shares are Shapley values: the part of the mean lit difference that swapping the cause "
            "removes, averaged over all orders of swapping; with +-, a 95 % confidence interval. Shares and "
            "the unexplained part add up to 100 %. Of FLIP: the same for the mean of HDR-FLIP. Alone: only "
            "this cause is swapped; last: it is swapped after all others. Largest at: share of the affected "
            "pixels where this cause is the largest. There: its share at its worst pixel, W/(sr m^2).",
        .indent = 2};
    const auto percentOf = [&](double contribution) { return percent(e.fractionOf(contribution)); };
    for (const Cause& cause : e.causes)
        table.rows.push_back(
            {{output::Text{swatch(e, cause), cause.name},
              percentOf(cause.contribution) + (cause.interval > 0 ? " +- " + percentOf(cause.interval) : ""),
              percent(e.fractionOfFlip(cause.flip)), percentOf(cause.alone), percentOf(cause.last),
              fmt::format("{:.1f} %", 100 * cause.dominates),
              fmt::format("{},{}", cause.worst_x, cause.worst_y), number(cause.worst), cause.description,
              partsOf(cause)}});
    table.rows.push_back(
        {{"unexplained", percentOf(e.unexplained), percent(e.fractionOfFlip(e.flip_unexplained)), "", "", "",
          "", "", "remains with every cause swapped", "no channel and no Setting describes it"},
         "soft"});
    return table;
}

output::Table deviceTable(const Explanation& e) {
    output::Table table{
        .columns = {{"across devices"}, {"share", Column::number}, {"description", Column::prose}},
        .box = "box scroll devices",
        .indent = 2};
    for (const DeviceContribution& part : e.devices)
        table.rows.push_back({{part.name, percent(e.fractionOf(part.contribution)), part.description}});
    return table;
}

output::List remarks(const Explanation& e, const ExplainedImages& of) {
    output::List list{{}, "box says"};
    const auto add = [&](const std::string& line) { list.items.emplace_back(line); };
    if (e.nonfinite > 0)
        add(fmt::format("excluded: {} with NaN or infinity in one of the pictures",
                        counted(e.nonfinite, "pixel")));
    for (const auto& [first, second, interaction] : e.pairs)
        add(fmt::format("{} and {} {} (interaction {:+.1f} %)", e.causes[first].name, e.causes[second].name,
                        interaction < 0 ? "are redundant" : "hide each other",
                        100 * e.fractionOf(interaction)));
    if (!e.without_effect.empty())
        add(fmt::format("differs without an effect on any pixel: {}", fmt::join(e.without_effect, ", ")));
    if (e.reproduction[0] != 0 || e.reproduction[1] != 0)
        add(fmt::format("lighting its own channels misses lit by {:.2g} % in {} and by {:.2g} % in {}",
                        100 * e.reproduction[0], of.baseline, 100 * e.reproduction[1], of.test));
    if (e.lights_omitted > 0)
        add(fmt::format("by light: the {} brightest were rendered alone, the other {} were not",
                        e.lights_drawn, e.lights_omitted));
    add(fmt::format("{} shaded from {}", counted(static_cast<std::uint64_t>(e.subsets), "picture"),
                    counted(static_cast<std::uint64_t>(e.frames), "rendered frame")));
    return list;
}

// Images of writeExplanation(), all on one scale but lit.
std::vector<Block> imageBlocks(const Explanation& e, const ExplainedImages& of) {
    Box maps{
        "maps",
        {ImageBlock{litFiles[0], "lit of the baseline", {Span(of.baseline, Span::foreign), ", the baseline"}},
         ImageBlock{litFiles[1], "lit of the test", Span(of.test, Span::foreign)}}};
    const auto add = [&](const std::string& file, const std::string& alt, output::Text caption) {
        maps.blocks.emplace_back(ImageBlock{file, alt, std::move(caption)});
    };
    if (e.distance > 0) add(differenceFile, "their difference", "difference");
    for (std::size_t i = 0; i < e.causes.size(); ++i)
        add(contributionFile(e, i), "share of " + e.causes[i].name,
            {swatch(e, e.causes[i]),
             e.causes[i].name + " " + percent(e.fractionOf(e.causes[i].contribution))});
    if (!e.causes.empty() && e.unexplained > 0)
        add(unexplainedFile, "the unexplained part", "unexplained " + percent(e.fractionOf(e.unexplained)));
    std::vector<Block> blocks{Heading{2, "The pictures"}, maps};
    if (e.distance > 0)
        blocks.insert(blocks.begin() + 1,
                      Paragraph{fmt::format("The difference and each cause's share of it are on one scale: "
                                            "black 0, pale yellow {} W/(sr m^2), cyan beyond; blue where "
                                            "the cause cancels others.",
                                            number(topOfMaps(e))),
                                "soft"});
    if (!e.causes.empty()) blocks.insert(blocks.begin(), causeMap(dominantFile));
    return blocks;
}

}  // namespace

std::string headlineOf(const Explanation& e) {
    if (e.distance == 0) return "no cause: lit is the same";
    const auto listed = [&](const auto& parts) {
        std::vector<std::string> items;
        for (const auto& part : parts)
            items.push_back(fmt::format("{} {:.1f} %", part.name, 100 * e.fractionOf(part.contribution)));
        return fmt::format("{}", fmt::join(items, ", "));
    };
    return fmt::format("lit differs {}{}; unexplained {:.1f} %{}{}",
                       e.causes.empty() ? "for an unknown reason" : "because of ", listed(e.causes),
                       100 * e.fractionOf(e.unexplained), e.devices.empty() ? "" : "; across devices by ",
                       listed(e.devices));
}

std::vector<Block> blocksOf(const Explanation& e, const ExplainedImages& of) {
    std::vector<Block> blocks{
        Heading{2, {"Why lit differs: ", Span(of.scene, Span::foreign)}}, Paragraph{headlineOf(e)},
        Paragraph{fmt::format("lit of {} differs from that of {} by {} W/(sr m^2) on average, FLIP {}",
                              of.test, of.baseline, number(e.distance), number(e.flip)),
                  "soft"}};
    if (!e.devices.empty()) blocks.emplace_back(deviceTable(e));
    if (e.distance > 0) blocks.emplace_back(causeTable(e));
    blocks.emplace_back(remarks(e, of));
    return blocks;
}

std::string explanationHtml(const Explanation& e, const ExplainedImages& of) {
    output::Document page{
        .title = "why lit differs, " + of.scene,
        .heading = of.scene,
        .about = {Span(of.test, Span::foreign), " against ", Span(of.baseline, Span::foreign),
                  fmt::format(", {}\u00d7{}, on {}", e.dominant.width, e.dominant.height, of.device)},
        .blocks = blocksOf(e, of),
        .files = {explanationManifest}};
    const auto add = [&](const std::vector<Block>& blocks) {
        page.blocks.insert(page.blocks.end(), blocks.begin(), blocks.end());
    };
    add(imageBlocks(e, of));
    Box commands{"box", {}};
    for (const ExplainedImages::Command& command : of.commands)
        commands.blocks.emplace_back(
            Paragraph{{command.does + " ", Span(command.line, Span::command)}, "again"});
    if (!of.commands.empty()) add({Heading{2, "Commands"}, commands});
    return inHtml(page);
}

std::string writeExplanation(const Explanation& explanation, const ExplainedImages& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, explanationManifest, force);
    std::vector<NamedImage> images = explanationMaps(explanation);
    for (std::size_t side = 0; side < 2; ++side) images.push_back({litFiles[side], std::move(lit.at(side))});
    images.push_back({dominantFile, dominantImage(explanation, images.back().image)});
    for (const NamedImage& image : images) folder.list(image.name);
    tbb::parallel_for(std::size_t{0}, images.size(),
                      [&](std::size_t i) { writePng(folder / images[i].name, images[i].image); });
    folder.put("index.html", explanationHtml(explanation, of));
    return folder.finish(toJson(explanation, of));
}

}  // namespace diptych
