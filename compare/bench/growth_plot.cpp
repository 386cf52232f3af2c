// SPDX-License-Identifier: MIT
#include "compare/bench/growth.h"
#include "compare/bench/plot_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {
namespace {

// Panels of time and memory side by side, in SVG user units.
constexpr double panelHeight = 260, panelTop = 50, panelBottom = 56, panelGap = 66;

struct Figure {
    const char* name;
    double (*amount)(const BenchRow&);
};
const Figure figures[] = {{"time of a frame, ms", [](const BenchRow& row) { return row.time.median; }},
                          {"memory on the device, MiB", memoryMib}};

std::string panelOf(const std::vector<GrowthLine>& lines, const Figure& figure, const PlotBox& box) {
    std::vector<double> values, amounts;
    for (const GrowthLine& line : lines)
        for (const BenchRow* row : line.rows) {
            values.push_back(row->growth->value);
            amounts.push_back(figure.amount(*row));
        }
    const LogAxis across(values), up(amounts);
    const auto x = [&](double n) { return box.left + across.place(n) * (box.right - box.left); };
    const auto y = [&](double a) { return box.bottom - up.place(a) * (box.bottom - box.top); };
    Drawing drawing;
    const GrowthAxis axis = lines.front().axis;
    drawing.axes(
        box, {across.ticks(), x, axis == GrowthAxis::textures ? "textures, MiB" : std::string(nameOf(axis))},
        {up.ticks(), y, ""});
    drawing.text("name", box.left, box.top - 16, figure.name);
    std::string out = drawing.group();
    for (const GrowthLine& line : lines) {
        std::vector<PlotPoint> points;
        for (const BenchRow* row : line.rows)
            points.push_back({x(row->growth->value), y(figure.amount(*row)),
                              fmt::format("{}, {:.6g} {}: {:.4g}", nameOf(line.path), row->growth->value,
                                          nameOf(axis), figure.amount(*row))});
        out += traceOf(line.path, "clustered", points);
    }
    return out;
}

}  // namespace

std::string growthPlot(const Bench& bench, PlotPlace place) {
    std::string out;
    double above = 0;
    std::vector<Path> paths;
    const std::vector<GrowthLine> all = growthLines(bench);
    for (std::size_t i = 0; i < all.size();) {
        std::vector<GrowthLine> lines;
        for (; i < all.size() && (lines.empty() || all[i].axis == lines.front().axis); ++i) {
            lines.push_back(all[i]);
            if (std::ranges::find(paths, all[i].path) == paths.end()) paths.push_back(all[i].path);
        }
        const double width = (plotWidth - plotRight - plotLeft - panelGap) / 2;
        double left = plotLeft;
        for (const Figure& figure : figures) {
            out += panelOf(lines, figure,
                           {left, above + panelTop, left + width, above + panelHeight - panelBottom});
            left += width + panelGap;
        }
        above += panelHeight;
    }
    Legend legend(above + 4);
    for (const Path path : paths) out += legendOf(legend, path, "clustered", std::string(nameOf(path)));
    return plotElement(plotWidth, std::max(legend.end(), panelHeight), "How a frame's time and memory grow",
                       place, out);
}

}  // namespace diptych::bench
