// SPDX-License-Identifier: MIT
// A benchmark for terminal, page and folder.
#include "compare/bench/findings.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::bench {

using output::Block;
using output::Column;
using output::Heading;

namespace {

// Rows, then skips.
std::vector<const experiment::Row*> allRows(const Bench& bench) {
    std::vector<const experiment::Row*> rows = experiment::pointersTo(bench.rows);
    for (const BenchRow& skip : bench.skips) rows.push_back(&skip);
    return rows;
}

// Notes that all rows share; shown once.
std::vector<std::string> commonNotes(const Bench& bench) {
    if (bench.rows.empty()) return {};
    std::vector<std::string> common = bench.rows.front().warnings;
    for (const BenchRow& row : bench.rows)
        std::erase_if(common,
                      [&](const std::string& note) { return std::ranges::count(row.warnings, note) == 0; });
    return common;
}

// A row for each of the benchmark's.
output::Table modeTable(const Bench& bench) {
    const std::vector<std::string> common = commonNotes(bench);
    output::Table table;
    const auto add = [&](Column column, const auto& textOf) {
        addColumn(table, std::move(column), bench.rows, textOf);
    };
    const auto addMs = [&](const char* title, Measure measure) {
        add({title, Column::number, 8}, [=](const BenchRow& row) { return msText(row[measure]); });
    };
    add({"lights", Column::number, 8},
        [](const BenchRow& row) { return fmt::format("{}", row.whole(Measure::lights)); });
    add({"size", Column::number, 9}, [](const BenchRow& row) {
        return fmt::format("{}x{}", row.settings.size.width, row.settings.size.height);
    });
    if (bench.options.table == BenchTable::growth || bench.options.table == BenchTable::layers)
        add({"amount", Column::text, 18}, [](const BenchRow& row) { return row.point(); });
    add({"path", Column::text, 12}, [](const BenchRow& row) { return nameOf(row.settings.path); });
    add({"assign", Column::text, bench.options.table == BenchTable::msaa ? 31u : 12u},
        [](const BenchRow& row) { return row.assignLabel(); });
    addMs("ms", Measure::ms);
    addMs("min", Measure::ms_min);
    addMs("max", Measure::ms_max);
    add({"memory", Column::number, 9},
        [](const BenchRow& row) { return page::bytes(row.whole(Measure::memory)); });
    add({"passes, ms", Column::prose}, [](const BenchRow& row) {
        std::vector<std::string> passes;
        for (const PassTime& pass : row.passes)
            passes.push_back(fmt::format("{} {:.3g}", pass.name, pass.ms));
        return fmt::format("{}", fmt::join(passes, ", "));
    });
    add({"notes", Column::prose, 0, Column::page}, [&](const BenchRow& row) {
        std::vector<std::string> own;
        for (const std::string& note : row.warnings)
            if (std::ranges::count(common, note) == 0) own.push_back(note);
        return fmt::format("{}", fmt::join(own, "; "));
    });
    return table;
}

// Conclusions and the tables besides modeTable().
std::vector<Block> findings(const Bench& bench) {
    if (bench.options.table == BenchTable::layers) return layerBlocks(bench);
    std::vector<Block> blocks;
    output::List sentences{{}, "box says"};
    if (bench.options.table == BenchTable::growth) {
        for (const std::string& text : growthText(bench)) sentences.items.emplace_back(text);
        if (!sentences.items.empty()) blocks = {Heading{2, "How time and memory grow"}};
    }
    for (const Conclusion& conclusion : conclusionsOf(bench))
        sentences.items.emplace_back(conclusion.describe());
    blocks.emplace_back(sentences);
    for (Block& block : sampleBlocks(bench)) blocks.push_back(std::move(block));
    return blocks;
}

// Skips and notes.
std::vector<Block> remarks(const Bench& bench) {
    std::vector<Block> blocks;
    output::Terms skips{{}, "box skips"};
    for (const BenchRow& skip : bench.skips) skips.items.emplace_back(skipName(skip), skip.failed);
    if (!bench.skips.empty()) blocks = {Heading{2, "Not timed, and why"}, skips};
    output::List notes{{}, "box says"};
    for (const BenchRow& row : bench.rows) {
        const auto note = [&](Measure measure, const std::string& text) {
            if (row.whole(measure) > 0)
                notes.items.emplace_back(fmt::format("{}, {}: {}", row.name(), row.lightsText(), text));
        };
        note(Measure::nonfinite_pixels,
             counted(row.whole(Measure::nonfinite_pixels), "pixel") + " not finite");
        note(Measure::unsorted_fragments,
             fmt::format("{} in {} overflowed the fragment list",
                         counted(row.whole(Measure::unsorted_fragments), "blended fragment"),
                         counted(row.whole(Measure::unsorted_pixels), "pixel")));
    }
    for (const std::string& text : commonNotes(bench)) notes.items.emplace_back(text);
    if (std::ranges::any_of(bench.rows,
                            [](const BenchRow& row) { return drawsAnotherImage(row.settings.assign); }))
        notes.items.emplace_back(starMeans);
    if (!notes.items.empty()) blocks.insert(blocks.end(), {Heading{2, "Notes"}, notes});
    return blocks;
}

output::List howItWasMeasured() {
    return {
        {"Time is the median over whole frames, not split into passes, from culling to linear lit. It "
         "includes making the light lists; the scene is already uploaded. Min and max are of single frames, "
         "and so are the ends of bars.",
         "All modes and sizes of one light count are interleaved, one frame of each per round, so a device "
         "that slows down affects all alike.",
         "Pass times are medians over as many other frames, with each pass timed by itself.",
         "The ratio of two modes is the median over frames of the same round. Its interval comes from a sign "
         "test, which holds for any distribution of times."},
        "box how"};
}

}  // namespace

std::string benchTable(const Bench& bench, std::size_t first) {
    return inText(modeTable(bench), first == 0 ? 0 : first + 1);
}

// The findings last: a terminal shows the end first.
std::string benchEnd(const Bench& bench) {
    return inText(remarks(bench)) + inText(findings(bench));
}

std::string benchHtml(const Bench& bench) {
    output::Document page{
        .title = "times, " + bench.scene,
        .heading = {"Times side by side: ", output::Span(bench.scene, output::Span::foreign)},
        .about = fmt::format("{} of {} each on {} ({})", counted(bench.rows.size(), "row"),
                             counted(static_cast<std::uint64_t>(bench.runs), "frame"), bench.device.name,
                             bench.device.driver),
        .blocks = findings(bench),
        .files = {benchManifest, experiment::rowsFile},
        .skip = "rows"};
    output::Box rows{"", {}, "rows"};
    if (!bench.rows.empty()) {
        page.files.emplace_back("bench.svg");
        page.blocks.emplace_back(
            output::Box{"box drawn", {output::Drawing{benchPlot(bench, PlotTarget::page)}}});
        rows.blocks = {Heading{2, "Every mode"}, modeTable(bench)};
    }
    page.blocks.emplace_back(rows);
    for (Block& block : remarks(bench)) page.blocks.push_back(std::move(block));
    page.blocks.insert(page.blocks.end(), {Heading{2, "How it was measured"}, howItWasMeasured()});
    return inHtml(page);
}

std::string writeBench(const Bench& bench, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, benchManifest, force);
    folder.put("index.html", benchHtml(bench));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(allRows(bench))));
    if (!bench.rows.empty()) folder.put("bench.svg", benchPlot(bench, PlotTarget::file));
    return folder.finish(benchJson(bench));
}

}  // namespace diptych::bench
