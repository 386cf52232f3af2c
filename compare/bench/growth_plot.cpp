// SPDX-License-Identifier: MIT
#include "compare/bench/growth.h"
#include "compare/bench/plot_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace diptych::bench {

std::string growthPlot(const Bench& bench, PlotPlace place) {
    std::map<GrowthAxis, std::vector<GrowthLine>> axes;
    for (const GrowthLine& line : growthLines(bench)) axes[line.axis].push_back(line);
    std::string out;
    std::size_t panels = 0;
    std::map<Path, PlotLine> entries;
    for (const auto& [axis, lines] : axes)
        for (const auto& [title, amountOf] :
             {std::pair{"time of a frame, ms", +[](const BenchRow& row) { return row[Measure::ms]; }},
              {"memory on the device, MiB", &memoryMib}}) {
            LinePanel panel{
                title, axis == GrowthAxis::textures ? "textures, MiB" : std::string(nameOf(axis)), "", {}};
            for (const GrowthLine& line : lines) {
                PlotLine& drawn = panel.lines.emplace_back(
                    PlotLine{line.path, "clustered", std::string(nameOf(line.path)), {}});
                for (const BenchRow* row : line.rows)
                    drawn.points.push_back({row->growth->value, amountOf(*row),
                                            fmt::format("{}, {:.6g} {}: {:.4g}", drawn.name,
                                                        row->growth->value, nameOf(axis), amountOf(*row))});
                entries.emplace(line.path, drawn);
            }
            const PlotBox box = smallBox(panels++);
            out += panelOf(panel, box, box.left);
        }
    Legend legend(belowSmall(panels));
    for (const auto& [path, line] : entries) out += legendOf(legend, line);
    return plotElement(plotWidth, legend.end(), "How a frame's time and memory grow", place, out);
}

}  // namespace diptych::bench
