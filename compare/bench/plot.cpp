// SPDX-License-Identifier: MIT
#include "compare/bench/growth.h"
#include "compare/bench/layer_table.h"
#include "compare/bench/plot_parts.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {

using page::markup;

namespace {

// SVG user units; the legend comes below.
constexpr double panel = 406, top = 60, bottom = 62;

struct Series {
    Path path;
    Assignment assign;
    ModeParts parts;
    std::vector<const BenchRow*> rows;  // ascending light counts
};

std::vector<Series> seriesOf(const Bench& bench, const Size& size) {
    std::vector<Series> all;
    for (const BenchRow& row : bench.rows) {
        if (row.settings.size != size) continue;
        const auto known = std::ranges::find_if(all, [&](const Series& s) {
            return s.path == row.settings.path && s.assign == row.settings.assign && s.parts == row.parts;
        });
        if (known != all.end())
            known->rows.push_back(&row);
        else
            all.push_back({row.settings.path, row.settings.assign, row.parts, {&row}});
    }
    for (Series& series : all)
        std::ranges::stable_sort(series.rows, {}, [](const BenchRow* row) { return row->counters.lights; });
    return all;
}

std::string groupOf(const Series& series, const std::string& inside) {
    return fmt::format("<g class=\"series {} {}\">{}</g>", nameOf(series.path), nameOf(series.assign),
                       inside);
}

Panel linesOf(const Bench& bench, const Size& size, double above) {
    const std::vector<Series> all = seriesOf(bench, size);
    std::vector<double> lights, ms;
    for (const Series& series : all)
        for (const BenchRow* row : series.rows) {
            lights.push_back(static_cast<double>(row->counters.lights));
            ms.insert(ms.end(), {row->time.min, row->time.median, row->time.max});
        }
    const LogAxis across(lights), up(ms);
    const PlotBox box{plotLeft, above + top, plotWidth - plotRight, above + panel - bottom};
    const auto x = [&](double n) { return box.left + across.place(n) * (box.right - box.left); };
    const auto y = [&](double t) { return box.bottom - up.place(t) * (box.bottom - box.top); };
    Drawing drawing;
    drawing.axes(box, {across.ticks(), x, "lights in the scene"}, {up.ticks(), y, "time of a frame, ms"});
    drawing.text("name", plotTitleLeft, above + 22,
                 fmt::format("{}x{}, {}", size.width, size.height, bench.scene));
    std::string out = drawing.group();
    Legend legend(above + panel + 4);
    for (const Series& series : all) {
        std::string line, marks;
        for (const BenchRow* r : series.rows) {
            const double px = x(static_cast<double>(r->counters.lights)), py = y(r->time.median);
            line += fmt::format("{}{} {}", line.empty() ? "M" : "L", svgNumber(px), svgNumber(py));
            marks +=
                fmt::format("<g><title>{}</title><path class=\"bar\" d=\"M{} {}V{}\"/>{}</g>",
                            markup(fmt::format("{}, {}: {} ms ({} to {})",
                                               modeLabel(series.path, series.assign, series.parts),
                                               counted(r->counters.lights, "light"), msText(r->time.median),
                                               msText(r->time.min), msText(r->time.max))),
                            svgNumber(px), svgNumber(y(r->time.min)), svgNumber(y(r->time.max)),
                            markAt(series.path, px, py));
        }
        out += groupOf(series, fmt::format("<path class=\"trace\" d=\"{}\"/>{}", line, marks));
        out += legendOf(legend, series.path, nameOf(series.assign),
                        modeLabel(series.path, series.assign, series.parts));
    }
    return {out, legend.end()};
}

}  // namespace

std::string markAt(Path path, double x, double y) {
    constexpr double r = 4;
    return hasGBuffer(path)
               ? fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", svgNumber(x),
                             svgNumber(y), r)
               : fmt::format("<rect class=\"mark\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                             svgNumber(x - r), svgNumber(y - r), 2 * r, 2 * r);
}

std::string benchPlot(const Bench& bench, PlotPlace place) {
    if (bench.options.table == BenchTable::growth) return growthPlot(bench, place);
    if (bench.options.table == BenchTable::layers) return layersPlot(bench, place);
    std::string panels;
    double above = 0;
    const bool oneCount = std::ranges::all_of(bench.rows, [&](const BenchRow& row) {
        return row.counters.lights == bench.rows.front().counters.lights;
    });
    for (const Size& size : sizesOf(bench)) {
        const Panel made = oneCount ? barsOf(bench, size, above) : linesOf(bench, size, above);
        panels += made.markup;
        above = made.end;
    }
    return plotElement(plotWidth, std::max(above, panel),
                       (oneCount ? "Time by pass, " : "Time against light count, ") + bench.scene, place,
                       panels);
}

}  // namespace diptych::bench
