// SPDX-License-Identifier: MIT
#include "compare/bench/sample_table.h"

#include "compare/output/writers.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::bench {
namespace {

constexpr double mebibyte = 1 << 20;
// The paper's deferred renderer: bytes per sample, and the image size for which it states memory.
constexpr std::uint64_t paperBytes = 32, paperPixels = 1920 * 1080;

double mebibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / mebibyte;
}

bool isOf(const SampleTable& table, const BenchRow& row) {
    return table.size == row.settings.size && table.scene == row.scene &&
           table.lights == row.whole(Measure::lights);
}

SampleTable::Line& lineOf(SampleTable& table, const Settings& settings) {
    const auto found = std::ranges::find_if(table.lines, [&](const SampleTable::Line& line) {
        return line.path == settings.path && line.transparency == settings.transparency;
    });
    if (found != table.lines.end()) return *found;
    return table.lines.emplace_back(SampleTable::Line{settings.path, settings.transparency, {}});
}

std::string title(const SampleTable& table) {
    return fmt::format("{}, {}x{}, {}", table.scene, table.size.width, table.size.height,
                       counted(table.lights, "light"));
}

std::string columnName(int samples) {
    return counted(static_cast<std::uint64_t>(samples), "sample");
}

// Header, width with the space before it, and text of a column.
struct CellPart {
    const char* name;
    std::size_t width;
    std::string (*text)(const BenchRow&);
};
const CellPart cellParts[] = {
    {"ms (min to max)", 26, [](const BenchRow& row) { return timeInWords(row); }},
    {"lighting ms", 13, [](const BenchRow& row) { return fmt::format("{:.3g}", lightingMs(row)); }},
    {"MiB", 9,
     [](const BenchRow& row) { return fmt::format("{:.4g}", mebibytes(row.whole(Measure::picture_bytes))); }},
    {"B/pixel", 9, [](const BenchRow& row) { return fmt::format("{}", row.whole(Measure::gbuffer_bytes)); }},
    {"B/sample", 10, [](const BenchRow& row) { return fmt::format("{}", bytesPerSample(row)); }}};

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
        const bool known =
            std::ranges::any_of(tables, [&](const SampleTable& table) { return isOf(table, row); });
        if (!known) tables.push_back({row.settings.size, row.scene, row.whole(Measure::lights), {}, {}});
    }
    for (SampleTable& table : tables) {
        for (const BenchRow& row : bench.rows)
            if (isOf(table, row) && std::ranges::count(table.columns, row.settings.msaa) == 0)
                table.columns.push_back(row.settings.msaa);
        std::ranges::sort(table.columns);
        for (const BenchRow& row : bench.rows) {
            if (!isOf(table, row)) continue;
            SampleTable::Line& line = lineOf(table, row.settings);
            line.cells.resize(table.columns.size(), nullptr);
            const auto column = std::ranges::find(table.columns, row.settings.msaa) - table.columns.begin();
            line.cells[static_cast<std::size_t>(column)] = &row;
        }
    }
    return tables;
}

double lightingMs(const BenchRow& row) {
    double ms = 0;
    for (const PassTime& pass : row.passes)
        if (pass.name.starts_with("shade")) ms += pass.ms;
    return ms;
}

std::uint64_t bytesPerSample(const BenchRow& row) {
    return row.whole(Measure::gbuffer_bytes) / static_cast<std::uint64_t>(row.settings.msaa);
}

std::vector<std::string> memoryInWords(const SampleTable& table) {
    std::vector<std::string> lines;
    std::vector<Path> told;
    for (const SampleTable::Line& line : table.lines) {
        if (std::ranges::count(told, line.path) > 0) continue;
        told.push_back(line.path);
        std::vector<std::string> samples, bytes, ours, theirs;
        for (const BenchRow* const row : line.cells) {
            if (!row) continue;
            const auto count = static_cast<std::uint64_t>(row->settings.msaa);
            samples.push_back(fmt::format("{}", count));
            bytes.push_back(fmt::format("{}", bytesPerSample(*row)));
            ours.push_back(
                fmt::format("{:.0f}", mebibytes(row->whole(Measure::gbuffer_bytes) * paperPixels)));
            theirs.push_back(fmt::format("{:.0f}", mebibytes(paperBytes * count * paperPixels)));
        }
        const std::string paper =
            hasGBuffer(line.path)
                ? fmt::format("; Billeter, Olsson and Assarsson store {} B per sample: {} MiB", paperBytes,
                              fmt::join(theirs, ", "))
                : "";
        lines.push_back(fmt::format(
            "{} stores {} B of {} per sample with {} samples per pixel: {} MiB at 1920x1080{}",
            nameOf(line.path), fmt::join(bytes, ", "), hasGBuffer(line.path) ? "G-buffer and depth" : "depth",
            fmt::join(samples, ", "), fmt::join(ours, ", "), paper));
    }
    return lines;
}

namespace {

output::Table outputOf(const SampleTable& table) {
    output::Table out{
        .columns = {{"", output::Column::words, 32}}, .style = "", .groups = {{"", 1}}, .gap = 0};
    for (const int samples : table.columns) {
        out.groups.emplace_back(columnName(samples), std::size(cellParts));
        for (const CellPart& part : cellParts)
            out.columns.push_back({part.name, output::Column::number, part.width});
    }
    for (const SampleTable::Line& line : table.lines) {
        output::Row& cells = out.rows.emplace_back(output::Row{{line.name()}});
        for (const BenchRow* const row : line.cells)
            for (const CellPart& part : cellParts)
                cells.cells.push_back(row ? output::Cell(part.text(*row)) : output::either("-", ""));
    }
    return out;
}

}  // namespace

std::string sampleTablesText(const Bench& bench) {
    std::string out;
    for (const SampleTable& table : sampleTables(bench)) {
        out += title(table) + "\n" + inText(outputOf(table));
        for (const std::string& words : memoryInWords(table)) out += words + "\n";
    }
    return out;
}

std::vector<output::Block> sampleBlocks(const Bench& bench) {
    std::vector<output::Block> blocks;
    for (const SampleTable& table : sampleTables(bench)) {
        blocks.emplace_back(output::Heading{2, "Samples per pixel: " + title(table)});
        blocks.emplace_back(outputOf(table));
        for (const std::string& words : memoryInWords(table))
            blocks.emplace_back(output::Paragraph{words, "soft"});
    }
    return blocks;
}

nlohmann::ordered_json sampleTablesJson(const Bench& bench) {
    using Json = nlohmann::ordered_json;
    Json all = Json::array();
    for (const SampleTable& table : sampleTables(bench)) {
        Json lines = Json::array();
        for (const SampleTable::Line& line : table.lines) {
            Json cells = Json::array();
            for (const BenchRow* const row : line.cells)
                if (row)
                    cells.push_back({{"samples", row->settings.msaa},
                                     {"ms",
                                      {{"median", (*row)[Measure::ms]},
                                       {"min", (*row)[Measure::ms_min]},
                                       {"max", (*row)[Measure::ms_max]}}},
                                     {"lighting_ms", lightingMs(*row)},
                                     {"image_mib", mebibytes(row->whole(Measure::picture_bytes))},
                                     {"bytes_per_pixel", row->whole(Measure::gbuffer_bytes)},
                                     {"bytes_per_sample", bytesPerSample(*row)}});
            lines.push_back({{"name", line.name()},
                             {"path", nameOf(line.path)},
                             {"transparency", nameOf(line.transparency)},
                             {"cells", cells}});
        }
        all.push_back({{"scene", table.scene},
                       {"size", {table.size.width, table.size.height}},
                       {"lights", table.lights},
                       {"columns", table.columns},
                       {"rows", lines},
                       {"memory", memoryInWords(table)}});
    }
    return all;
}

}  // namespace diptych::bench
