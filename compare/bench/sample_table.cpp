// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace diptych::bench {
namespace {

constexpr std::uint64_t statedPixels = 1920 * 1080;  // image size for which memory is stated

double mebibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / (1 << 20);
}

}  // namespace

std::string SampleTable::Line::name() const {
    return transparency == Transparency::off
               ? fmt::format("{}, opaque only", nameOf(path))
               : fmt::format("{}, transparency {}", nameOf(path), nameOf(transparency));
}

std::vector<SampleTable> sampleTables(const Bench& bench) {
    std::vector<SampleTable> tables;
    if (bench.options.table != BenchTable::msaa) return tables;
    for (const BenchRow& row : bench.rows) {
        const Settings& s = row.settings;
        const std::uint64_t lights = row.whole(Measure::lights);
        auto table = std::ranges::find_if(tables, [&](const SampleTable& known) {
            return known.size == s.size && known.scene == row.scene && known.lights == lights;
        });
        if (table == tables.end()) table = tables.insert(table, {s.size, row.scene, lights});
        auto line = std::ranges::find_if(table->lines, [&](const SampleTable::Line& known) {
            return known.path == s.path && known.transparency == s.transparency;
        });
        if (line == table->lines.end()) line = table->lines.insert(line, {s.path, s.transparency});
        line->cells[s.msaa] = &row;
        table->columns.insert(s.msaa);
    }
    return tables;
}

std::uint64_t bytesPerSample(const BenchRow& row) {
    return row.whole(Measure::gbuffer_bytes) / static_cast<std::uint64_t>(row.settings.msaa);
}

double imageMib(const BenchRow& row) {
    return mebibytes(row.whole(Measure::full_size_bytes));
}

std::vector<std::string> memoryText(const SampleTable& table) {
    std::vector<std::string> lines;
    std::vector<Path> listed;
    for (const SampleTable::Line& line : table.lines) {
        if (std::ranges::count(listed, line.path) > 0) continue;
        listed.push_back(line.path);
        std::vector<std::string> samples, bytes, mib;
        for (const auto& [count, row] : line.cells) {
            samples.push_back(fmt::format("{}", count));
            bytes.push_back(fmt::format("{}", bytesPerSample(*row)));
            mib.push_back(
                fmt::format("{:.0f}", mebibytes(row->whole(Measure::gbuffer_bytes) * statedPixels)));
        }
        lines.push_back(fmt::format(
            "{} stores {} B of {} per sample with {} samples per pixel: {} MiB at 1920x1080",
            nameOf(line.path), fmt::join(bytes, ", "), hasGBuffer(line.path) ? "G-buffer and depth" : "depth",
            fmt::join(samples, ", "), fmt::join(mib, ", ")));
    }
    return lines;
}

std::vector<output::Block> sampleBlocks(const Bench& bench) {
    std::vector<output::Block> blocks;
    for (const SampleTable& table : sampleTables(bench)) {
        output::Table shown{.columns = {}, .style = "", .groups = {{"", 1}}};
        addColumn(shown, {""}, table.lines, std::mem_fn(&SampleTable::Line::name));
        for (const int samples : table.columns) {
            const auto add = [&](const char* title, const auto& textOf) {
                addColumn(shown, {title, output::Column::number}, table.lines,
                          [&](const SampleTable::Line& line) {
                              const auto cell = line.cells.find(samples);
                              return cell != line.cells.end() ? textOf(*cell->second) : "-";
                          });
            };
            shown.groups.emplace_back(counted(static_cast<std::uint64_t>(samples), "sample"), 4);
            add("ms (min to max)", describeTime);
            add("lighting ms",
                [](const BenchRow& row) { return fmt::format("{:.3g}", passMs(row, "shade")); });
            add("MiB", [](const BenchRow& row) { return fmt::format("{:.4g}", imageMib(row)); });
            add("B/pixel",
                [](const BenchRow& row) { return fmt::format("{}", row.whole(Measure::gbuffer_bytes)); });
        }
        blocks.emplace_back(
            output::Heading{2, fmt::format("Samples per pixel: {}, {}x{}, {}", table.scene, table.size.width,
                                           table.size.height, counted(table.lights, "light"))});
        blocks.emplace_back(std::move(shown));
        for (const std::string& text : memoryText(table))
            blocks.emplace_back(output::Paragraph{text, "soft"});
    }
    return blocks;
}

}  // namespace diptych::bench
