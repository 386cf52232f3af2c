// SPDX-License-Identifier: MIT
// Terminal text of a benchmark.
#include "compare/bench/bench.h"
#include "compare/bench/conclusion.h"
#include "compare/bench/growth.h"
#include "compare/bench/sample_table.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {

std::string benchTable(const Bench& bench, std::size_t first) {
    std::string out;
    if (first == 0)
        out = fmt::format("{:>8}  {:>9}  {:<12}  {:<12}  {:>8}  {:>8}  {:>8}  {:>9}  {:>6}  passes, ms\n",
                          "lights", "size", "path", "assign", "ms", "min", "max", "assign ms", "share");
    for (std::size_t i = first; i < bench.rows.size(); ++i) {
        const BenchRow& row = bench.rows[i];
        std::string passes;
        for (const PassTime& pass : row.passes)
            passes += fmt::format("{}{} {:.3g}", passes.empty() ? "" : ", ", pass.name, pass.ms);
        out += fmt::format(
            "{:>8}  {:>9}  {:<12}  {:<12}  {:>8}  {:>8}  {:>8}  {:>9.3g}  {:>5.1f}%  {}\n",
            row.counters.lights, fmt::format("{}x{}", row.settings.size.width, row.settings.size.height),
            nameOf(row.settings.path), assignLabel(row.settings.assign, row.parts), msText(row.time.median),
            msText(row.time.min), msText(row.time.max), assignMs(row), 100 * assignShare(row), passes);
    }
    return out;
}

std::string kernelTable(const KernelReport& kernels) {
    std::string out = fmt::format(
        "\none listed point light at one pixel: the difference between lists of {} and {} out of {} lights, "
        "{}x{}, {}, {}\n{:<44}  {:>6}  {:>15}  {:>6}\n",
        kernels.short_list, kernels.long_list, kernels.lights, kernels.size.width, kernels.size.height,
        counted(static_cast<std::uint64_t>(kernels.runs), "run"),
        counted(static_cast<std::uint64_t>(kernels.threads), "thread"), "kernel", "ns", "ratio to CPU",
        "goal");
    for (const KernelRow& row : kernels.rows)
        out += fmt::format("{:<44}  {:>6.3f}  {:>15}  {:>6}\n", row.name, row.ns,
                           row.ratio ? fmt::format("{:.2f}", *row.ratio) : "-",
                           row.goal ? fmt::format("{:.1f}", *row.goal) : "-");
    for (const std::string& note : kernels.notes) out += note + "\n";
    return out;
}

std::string benchEnd(const Bench& bench) {
    std::string out;
    for (const BenchSkip& skip : bench.skips)
        out += fmt::format("not timed: {}: {}\n", skipName(skip), skip.reason);
    for (const BenchRow& row : bench.rows)
        if (row.counters.nonfinite_pixels > 0)
            out += fmt::format(
                "{}, {}: {} not finite\n", modeName(row.settings.path, row.settings.assign, row.parts),
                counted(row.counters.lights, "light"), counted(row.counters.nonfinite_pixels, "pixel"));
    for (const BenchRow& row : bench.rows)
        if (row.counters.unsorted.fragments > 0)
            out += fmt::format("{}, {}: {} in {} overflowed the fragment list\n",
                               modeName(row.settings.path, row.settings.assign, row.parts),
                               counted(row.counters.lights, "light"),
                               counted(row.counters.unsorted.fragments, "blended fragment"),
                               counted(row.counters.unsorted.pixels, "pixel"));
    if (bench.kernels) out += kernelTable(*bench.kernels);
    for (const std::string& note : commonNotes(bench)) out += note + "\n";
    if (hasAnotherPicture(bench)) out += std::string(starMeans) + "\n";
    if (bench.options.table == BenchTable::growth) return out + growthText(bench);
    if (bench.options.table == BenchTable::msaa) out += "\n" + sampleTablesText(bench);
    // Conclusions last: a terminal shows the end first.
    for (const Conclusion& conclusion : conclusionsOf(bench)) out += conclusion.inWords() + "\n";
    return out;
}

}  // namespace diptych::bench
