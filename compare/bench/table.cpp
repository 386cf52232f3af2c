// SPDX-License-Identifier: MIT
// Tables of a benchmark, and its terminal text.
#include "compare/bench/bench.h"
#include "compare/bench/conclusion.h"
#include "compare/bench/growth.h"
#include "compare/bench/layer_table.h"
#include "compare/bench/sample_table.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::bench {

using output::Column;

namespace {

// The row's notes that other rows lack.
std::string ownNotes(const BenchRow& row, const std::vector<std::string>& common) {
    std::vector<std::string> own;
    for (const std::string& note : row.warnings)
        if (std::ranges::count(common, note) == 0) own.push_back(note);
    return fmt::format("{}", fmt::join(own, "; "));
}

// ", 1e+06 triangles" with --table growth, ", 5 % coated" with --table layers.
std::string pointOf(const BenchRow& row) {
    if (row.cover) return ", " + coverName(*row.cover);
    return row.growth ? fmt::format(", {:.6g} {}", row.growth->value, nameOf(row.growth->axis)) : "";
}

}  // namespace

std::string passesInWords(const BenchRow& row) {
    std::string words;
    for (const PassTime& pass : row.passes)
        words += fmt::format("{}{} {:.3g}", words.empty() ? "" : ", ", pass.name, pass.ms);
    return words;
}

output::Table modeTable(const Bench& bench) {
    output::Table table{{{"lights", Column::number, 8},
                         {"size", Column::number, 9},
                         {"path", Column::words, 12},
                         {"assign", Column::words, 12},
                         {"ms", Column::number, 8},
                         {"min", Column::number, 8},
                         {"max", Column::number, 8},
                         {"assign ms", Column::number, 9},
                         {"share", Column::number, 6},
                         {"memory", Column::number, 0, Column::page},
                         {"passes, ms", Column::prose},
                         {"notes", Column::prose, 0, Column::page}}};
    const std::vector<std::string> common = commonNotes(bench);
    for (const BenchRow& row : bench.rows) {
        const double share = 100 * assignShare(row);
        table.rows.push_back(
            {{fmt::format("{}", row.whole(Measure::lights)),
              fmt::format("{}x{}", row.settings.size.width, row.settings.size.height),
              std::string(nameOf(row.settings.path)) + pointOf(row),
              assignLabel(row.settings.assign, row.parts), msText(row[Measure::ms]),
              msText(row[Measure::ms_min]), msText(row[Measure::ms_max]),
              fmt::format("{:.3g}", assignMs(row)),
              output::either(fmt::format("{:.1f}%", share), fmt::format("{:.1f} %", share)),
              page::bytes(row.whole(Measure::memory)), passesInWords(row), ownNotes(row, common)}});
    }
    return table;
}

std::string benchTable(const Bench& bench, std::size_t first) {
    return inText(modeTable(bench), first == 0 ? 0 : first + 1);
}

std::string benchEnd(const Bench& bench) {
    std::string out;
    for (const BenchRow& skip : bench.skips)
        out += fmt::format("not timed: {}: {}\n", skipName(skip), skip.failed);
    for (const BenchRow& row : bench.rows)
        if (row.whole(Measure::nonfinite_pixels) > 0)
            out += fmt::format("{}, {}: {} not finite\n", row.name(),
                               counted(row.whole(Measure::lights), "light"),
                               counted(row.whole(Measure::nonfinite_pixels), "pixel"));
    for (const BenchRow& row : bench.rows)
        if (row.whole(Measure::unsorted_fragments) > 0)
            out += fmt::format("{}, {}: {} in {} overflowed the fragment list\n", row.name(),
                               counted(row.whole(Measure::lights), "light"),
                               counted(row.whole(Measure::unsorted_fragments), "blended fragment"),
                               counted(row.whole(Measure::unsorted_pixels), "pixel"));
    for (const std::string& note : commonNotes(bench)) out += note + "\n";
    if (hasAnotherPicture(bench)) out += std::string(starMeans) + "\n";
    if (bench.options.table == BenchTable::growth) return out + growthText(bench);
    if (bench.options.table == BenchTable::layers) return out + layersText(bench);
    if (bench.options.table == BenchTable::msaa) out += "\n" + sampleTablesText(bench);
    // Conclusions last: a terminal shows the end first.
    for (const Conclusion& conclusion : conclusionsOf(bench)) out += conclusion.inWords() + "\n";
    return out;
}

}  // namespace diptych::bench
