// SPDX-License-Identifier: MIT
#include "compare/bench/growth.h"
#include "compare/bench/layer_table.h"
#include "compare/bench/plot_parts.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {
namespace {

// SVG user units; the legend comes below.
constexpr double panel = 406, top = 60, bottom = 62;

// A line for each mode, ascending light counts.
std::vector<PlotLine> linesOf(const Bench& bench, const Size& size) {
    std::vector<PlotLine> lines;
    for (const BenchRow& row : bench.rows) {
        if (row.settings.size != size) continue;
        const std::string name = modeLabel(row.settings.path, row.settings.assign, row.parts);
        auto line = std::ranges::find(lines, name, &PlotLine::name);
        if (line == lines.end())
            line =
                lines.insert(line, {row.settings.path, std::string(nameOf(row.settings.assign)), name, {}});
        line->points.push_back({row[Measure::lights], row[Measure::ms],
                                fmt::format("{}, {}: {} ms", name,
                                            counted(row.whole(Measure::lights), "light"), timeInWords(row)),
                                row[Measure::ms_min], row[Measure::ms_max]});
    }
    for (PlotLine& line : lines) std::ranges::stable_sort(line.points, {}, &PlotPoint::x);
    return lines;
}

Panel panelOf(const Bench& bench, const Size& size, double above) {
    const LinePanel lines{fmt::format("{}x{}, {}", size.width, size.height, bench.scene),
                          "lights in the scene", "time of a frame, ms", linesOf(bench, size)};
    std::string out =
        panelOf(lines, {plotLeft, above + top, plotWidth - plotRight, above + panel - bottom}, plotTitleLeft);
    Legend legend(above + panel + 4);
    for (const PlotLine& line : lines.lines) out += legendOf(legend, line);
    return {out, legend.end()};
}

}  // namespace

std::string benchPlot(const Bench& bench, PlotPlace place) {
    if (bench.options.table == BenchTable::growth) return growthPlot(bench, place);
    if (bench.options.table == BenchTable::layers) return layersPlot(bench, place);
    std::string panels;
    double above = 0;
    const bool oneCount = std::ranges::all_of(bench.rows, [&](const BenchRow& row) {
        return row[Measure::lights] == bench.rows.front()[Measure::lights];
    });
    for (const Size& size : sizesOf(bench)) {
        const Panel made = oneCount ? barsOf(bench, size, above) : panelOf(bench, size, above);
        panels += made.markup;
        above = made.end;
    }
    return plotElement(plotWidth, std::max(above, panel),
                       (oneCount ? "Time by pass, " : "Time against light count, ") + bench.scene, place,
                       panels);
}

}  // namespace diptych::bench
