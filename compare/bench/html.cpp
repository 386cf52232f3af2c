// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/bench/conclusion.h"
#include "compare/bench/growth.h"
#include "compare/bench/layer_table.h"
#include "compare/bench/sample_table.h"
#include "compare/output/writers.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

namespace diptych::bench {

using output::Block;
using output::Heading;
using output::Paragraph;
using output::Span;

namespace {

Block rows(const Bench& bench) {
    output::Box box{"", {}, "rows"};
    if (bench.rows.empty()) return box;
    box.blocks = {Heading{2, "Every mode"}, modeTable(bench)};
    if (hasAnotherPicture(bench)) box.blocks.emplace_back(Paragraph{starMeans, "soft"});
    return box;
}

// Tables and sentences besides modeTable().
std::vector<Block> tableBlocks(const Bench& bench) {
    switch (bench.options.table) {
        case BenchTable::modes:
            return {};
        case BenchTable::msaa:
            return sampleBlocks(bench);
        case BenchTable::growth:
            return growthBlocks(bench);
        case BenchTable::layers:
            return layerBlocks(bench);
    }
    return {};
}

void addSkips(std::vector<Block>& blocks, const std::vector<BenchRow>& skips) {
    if (skips.empty()) return;
    output::Terms terms{{}, "box skips"};
    for (const BenchRow& skip : skips) terms.items.emplace_back(skipName(skip), skip.failed);
    blocks.insert(blocks.end(), {Heading{2, "Not timed, and why"}, terms});
}

output::List how(const Bench& bench) {
    output::List list{
        {"Time is the median over whole frames, not split into passes, from culling to linear lit. It "
         "includes making the light lists; the scene is already uploaded. Min and max are of single frames, "
         "and so are the ends of bars.",
         "All modes and sizes of one light count are interleaved, one frame of each per round, so a device "
         "that slows down affects all alike.",
         "Pass times are medians over as many other frames, with each pass timed by itself. The share is the "
         "fraction of pass time that makes light lists.",
         "The ratio of two modes is the median over frames of the same round. Its interval comes from a sign "
         "test, which holds for any distribution of times."},
        "box how"};
    for (const std::string& note : commonNotes(bench)) list.items.emplace_back(note);
    return list;
}

}  // namespace

std::string benchHtml(const Bench& bench) {
    output::Document page{.title = "times, " + bench.scene,
                          .heading = {"Times side by side: ", Span(bench.scene, Span::foreign)},
                          .about = fmt::format("{} of {} each on {} ({})", counted(bench.rows.size(), "row"),
                                               counted(static_cast<std::uint64_t>(bench.runs), "frame"),
                                               bench.device.name, bench.device.driver),
                          .blocks = {},
                          .files = {"bench.json", experiment::rowsFile},
                          .style = plotStyle,
                          .skip = "rows"};
    output::List conclusions{{}, "box says"};
    for (const Conclusion& conclusion : conclusionsOf(bench))
        conclusions.items.emplace_back(conclusion.inWords());
    page.blocks = {conclusions};
    for (Block& block : tableBlocks(bench)) page.blocks.push_back(std::move(block));
    if (!bench.rows.empty()) {
        page.files.emplace_back("bench.svg");
        page.blocks.emplace_back(
            output::Box{"box drawn", {output::Drawing{benchPlot(bench, PlotPlace::page)}}});
    }
    page.blocks.push_back(rows(bench));
    page.blocks.push_back(experiment::rowsBox(allRows(bench)));
    addSkips(page.blocks, bench.skips);
    page.blocks.insert(page.blocks.end(), {Heading{2, "How it was measured"}, how(bench)});
    return inHtml(page);
}

}  // namespace diptych::bench
