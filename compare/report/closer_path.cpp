// SPDX-License-Identifier: MIT
// Both paths' errors against the reference and their difference from each other: which path has the lower
// error, where, and by how much.
#include "compare/report/document.h"
#include "compare/report/titles.h"

#include <fmt/format.h>

namespace diptych {

using output::Block;
using output::Box;
using output::Column;
using output::Paragraph;
using output::Span;
using output::Table;
using page::number;

namespace {

output::Text cell(double value, bool best) {
    return Span(number(value), best ? Span::strong : Span::plain);
}

// The metrics of both paths and of their difference; the lower error is bold.
void addMetrics(std::vector<Block>& blocks, const Report& report, const CloserPath& closer) {
    const auto name = [&](std::size_t k) { return report.frames[closer.paths[k]].name; };
    Table table{
        .columns = {{.title = "errors", .style = "soft wide"},
                    {name(0), Column::number},
                    {name(1), Column::number},
                    {"between them", Column::number}},
        .style = "",
        .box = "scroll",
        .note = fmt::format("Each path's error against the {}; the smaller one in bold. Between them: "
                            "{} against {}.",
                            report.frames[closer.reference].name, name(1), name(0))};
    for (const CloserPathChannel& channel : closer.channels) {
        const auto add = [&](const char* metric, const auto& value) {
            const double first = value(channel.paths[0]), second = value(channel.paths[1]);
            table.rows.push_back({{metric, cell(first, first < second), cell(second, second < first),
                                   number(value(channel.between))}});
        };
        table.rows.push_back({{Span(channel.mode->name, Span::name), "", "", ""}, "head"});
        add("mean", [](const PathError& error) { return error.stats.mean; });
        add("p99", [](const PathError& error) { return error.stats.p99; });
        add("p99.9", [](const PathError& error) { return error.stats.p999; });
        add("max", [](const PathError& error) { return error.stats.max; });
        add("relative RMSE", [](const PathError& error) { return error.relative_rmse; });
        add("FLIP", [](const PathError& error) { return error.flip.value_or(0); });
    }
    blocks.emplace_back(table);
}

void addMaterials(std::vector<Block>& blocks, const Report& report, const CloserPath& closer,
                  const CloserPathChannel& channel) {
    if (channel.materials.empty() || channel.closer < 0) return;
    const auto name = [&](std::size_t k) { return report.frames[closer.paths[k]].name; };
    Table table{.columns = {{.title = fmt::format("{} by material", channel.mode->name), .style = "wide"},
                            {"pixels", Column::number},
                            {name(0), Column::number},
                            {name(1), Column::number}},
                .style = "",
                .box = "scroll",
                .note =
                    "Mean errors. The materials that add most to the difference of the paths (mean times "
                    "pixels) come first."};
    for (const MaterialError& m : channel.materials)
        table.rows.push_back({{output::Text{fmt::format("{} ", m.id), Span(m.name, Span::plain, "soft")},
                               fmt::format("{}", m.pixels), cell(m.mean[0], m.mean[0] < m.mean[1]),
                               cell(m.mean[1], m.mean[1] < m.mean[0])}});
    blocks.emplace_back(table);
}

}  // namespace

std::vector<Block> closerPathBlocks(const Report& report, const ReportLayout* layout, std::size_t index,
                                    bool several) {
    const CloserPath& closer = report.closer_paths[index];
    const Frame& reference = report.frames[closer.reference];
    std::vector<Block> blocks;
    if (several)
        blocks.emplace_back(Paragraph{fmt::format("{}, {}:", reference.scene, viewTitle(report, reference))},
                            Block::terminal);
    output::List lines;
    for (const CloserPathChannel& channel : closer.channels)
        lines.items.emplace_back(closerPathLine(closer, channel, report.frames));
    blocks.emplace_back(lines);
    if (!layout || closer.channels.empty()) return blocks;
    const CloserPathChannel& first = closer.channels.front();
    Box columns{"columns", {Box{}, Box{}}};
    Box &left = std::get<Box>(columns.blocks[0].content), &right = std::get<Box>(columns.blocks[1].content);
    if (const std::string& file = layout->closer_paths[index].front(); !file.empty())
        left.blocks.emplace_back(output::ImageBlock{
            layout->source(file),
            "which path is closer, pixel by pixel",
            {Span("", Span::swatch, "first"), report.frames[closer.paths[0]].name + " closer",
             Span("", Span::swatch, "second"), report.frames[closer.paths[1]].name + " closer",
             Span(fmt::format("{}: brightness is the difference of the errors, full at {}", first.mode->name,
                              number(closerPathTop(first.error_difference))),
                  Span::plain, "soft")}});
    addMaterials(left.blocks, report, closer, first);
    addMetrics(right.blocks, report, closer);
    blocks.emplace_back(columns);
    return blocks;
}

}  // namespace diptych
