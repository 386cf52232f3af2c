// SPDX-License-Identifier: MIT
#include "compare/bench/layer_table.h"
#include "compare/bench/plot_parts.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace diptych::bench {
namespace {

// A way's line without points. The two of deferred differ in colour.
PlotLine lineOf(std::size_t way) {
    const LayerWay& of = layerWays.at(way);
    return {of.path(), of.layers == Layers::forward ? "layers" : "clustered", of.name(), {}};
}

// Rows of a kind, and without layers, under one light count. Shares stand at even distances.
LinePanel panelOf(const std::vector<LayerRow>& all, std::string_view kind, std::uint64_t lights) {
    LinePanel panel{fmt::format("{}, {}: ms", kind, counted(lights, "light")), "covered, %", "", {}};
    for (std::size_t way = 0; way < layerWays.size(); ++way) panel.lines.push_back(lineOf(way));
    for (const LayerRow& row : all) {
        if (row.lights != lights || !(row.cover.kind.empty() || row.cover.kind == kind)) continue;
        for (std::size_t way = 0; way < layerWays.size(); ++way)
            if (const BenchRow* const timed = row.ways.at(way))
                panel.lines[way].points.push_back({static_cast<double>(panel.places.size()),
                                                   (*timed)[Measure::ms],
                                                   fmt::format("{}, {}: {} ms", panel.lines[way].name,
                                                               coverName(row.cover), timeInWords(*timed))});
        panel.places.push_back(fmt::format("{}", row.cover.percent));
    }
    std::erase_if(panel.lines, [](const PlotLine& line) { return line.points.empty(); });
    return panel;
}

}  // namespace

std::string layersPlot(const Bench& bench, PlotPlace place) {
    const std::vector<LayerRow> rows = layerRows(bench);
    std::vector<std::string_view> kinds;  // in the table's order
    std::set<std::uint64_t> counts;
    for (const LayerRow& row : rows) {
        if (!row.cover.kind.empty() && std::ranges::count(kinds, row.cover.kind) == 0)
            kinds.push_back(row.cover.kind);
        counts.insert(row.lights);
    }
    std::string out;
    std::size_t panels = 0;
    for (const std::uint64_t lights : counts)
        for (const std::string_view kind : kinds) {
            const PlotBox box = smallBox(panels++);
            out += panelOf(panelOf(rows, kind, lights), box, box.left);
        }
    Legend legend(belowSmall(panels));
    for (std::size_t way = 0; way < layerWays.size(); ++way) out += legendOf(legend, lineOf(way));
    return plotElement(plotWidth, legend.end(), "Time of a frame by what layers cover", place, out);
}

}  // namespace diptych::bench
