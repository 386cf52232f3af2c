// SPDX-License-Identifier: MIT
// Plots of a benchmark.
#include "compare/plot/plot.h"
#include "compare/bench/findings.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {
namespace {

constexpr double smallHeight = 260;  // of one panel of many

// Time over light count: a panel per size, a series per mode.
Plot modesPlot(const Bench& bench, const std::vector<Size>& sizes) {
    Plot plot{.title = "Time against light count, " + bench.scene, .interval = "least to greatest time"};
    for (const Size& size : sizes) {
        PlotPanel panel{.across = {"lights in the scene"},
                        .up = {fmt::format("{}x{}, {}: ms", size.width, size.height, bench.scene)}};
        for (const BenchRow& row : bench.rows)
            if (row.settings.size == size)
                panel.pointsOf(row.label(), row.settings.path)
                    .push_back(
                        {row[Measure::lights],
                         row[Measure::ms],
                         fmt::format("{}, {}: {} ms", row.label(), row.lightsText(), describeTime(row)),
                         {},
                         {row[Measure::ms_min], row[Measure::ms_max]}});
        for (PlotSeries& series : panel.series) std::ranges::stable_sort(series.points, {}, &PlotPoint::x);
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

// Time and memory of each axis, a series per path.
Plot growthPlot(const Bench& bench) {
    std::map<GrowthAxis, std::vector<GrowthLine>> axes;
    for (const GrowthLine& line : growthLines(bench)) axes[line.axis].push_back(line);
    Plot plot{.title = "How a frame's time and memory grow", .columns = 2, .height = smallHeight};
    for (const auto& [axis, lines] : axes)
        for (const auto& [name, amountOf] :
             {std::pair{"time of a frame, ms", +[](const BenchRow& row) { return row[Measure::ms]; }},
              {"memory on the device, MiB", &memoryMib}}) {
            PlotPanel panel{
                .across = {axis == GrowthAxis::textures ? "textures, MiB" : std::string(nameOf(axis))},
                .up = {name}};
            for (const GrowthLine& line : lines) {
                const std::string path(nameOf(line.path));
                for (const BenchRow* row : line.rows)
                    panel.pointsOf(path, line.path)
                        .push_back({row->growth->value, amountOf(*row),
                                    fmt::format("{}, {}: {:.4g}", path, row->point(), amountOf(*row))});
            }
            plot.panels.push_back(std::move(panel));
        }
    return plot;
}

// Time over the covered fraction: a panel per light count and kind, a series per way. Rows without layers are
// in each. Fractions stand at even distances.
Plot layersPlot(const Bench& bench) {
    const std::vector<LayerRow> rows = layerRows(bench);
    std::vector<std::string_view> kinds;  // in the table's order
    std::set<std::uint64_t> counts;
    for (const LayerRow& row : rows) {
        if (!row.cover.kind.empty() && std::ranges::count(kinds, row.cover.kind) == 0)
            kinds.push_back(row.cover.kind);
        counts.insert(row.lights);
    }
    Plot plot{.title = "Time of a frame by what layers cover", .columns = 2, .height = smallHeight};
    for (const std::uint64_t lights : counts)
        for (const std::string_view kind : kinds) {
            PlotPanel panel{.across = {"covered, %"},
                            .up = {fmt::format("{}, {}: ms", kind, counted(lights, "light"))}};
            for (const LayerRow& row : rows) {
                if (row.lights != lights || !(row.cover.kind.empty() || row.cover.kind == kind)) continue;
                for (std::size_t way = 0; way < layerWays.size(); ++way)
                    if (const BenchRow* const timed = row.ways.at(way))
                        panel.pointsOf(layerWays[way].name(), layerWays[way].path())
                            .push_back({static_cast<double>(panel.across.categories.size()),
                                        (*timed)[Measure::ms],
                                        fmt::format("{}, {}: {} ms", layerWays[way].name(),
                                                    coverName(row.cover), describeTime(*timed))});
                panel.across.categories.push_back(fmt::format("{}", row.cover.percent));
            }
            plot.panels.push_back(std::move(panel));
        }
    return plot;
}

// Passes in order. If there are more than colours, the longest ones and one merged entry.
std::vector<std::string> passNames(const std::vector<BenchRow>& rows) {
    std::vector<std::string> names;
    std::map<std::string, double> max;
    for (const BenchRow& row : rows)
        for (const PassTime& pass : row.passes) {
            if (!max.contains(pass.name)) names.push_back(pass.name);
            max[pass.name] = std::max(max[pass.name], pass.ms);
        }
    if (names.size() <= maxParts) return names;
    std::vector<double> times;
    for (const auto& [name, ms] : max) times.push_back(ms);
    std::ranges::sort(times, std::greater<>());
    std::erase_if(names, [&](const std::string& name) { return max[name] <= times[maxParts - 1]; });
    names.emplace_back("other passes");
    return names;
}

// A panel per size, a bar per row, stacked by the median times of its passes. Marks the median of whole
// frames and their range.
Plot barsPlot(const Bench& bench, const std::vector<Size>& sizes) {
    Plot plot{.title = "Time by pass, " + bench.scene, .parts = passNames(bench.rows)};
    for (const Size& size : sizes) {
        PlotPanel panel{.across = {"passes of a profiled frame, one after the other, ms", false}};
        for (const BenchRow& row : bench.rows) {
            if (row.settings.size != size) continue;
            const std::string label = row.label();
            const PlotRange up = barAt(static_cast<double>(panel.up.categories.size()));
            panel.up.name =
                fmt::format("{}x{}, {}, {}", size.width, size.height, row.lightsText(), bench.scene);
            panel.up.categories.push_back(fmt::format("{}: {} ms", label, msText(row[Measure::ms])));
            double from = 0;
            for (const PassTime& pass : row.passes) {
                const auto part =
                    std::min(std::ranges::find(plot.parts, pass.name), std::prev(plot.parts.end()));
                panel.bars.push_back({{from, from + pass.ms},
                                      up,
                                      static_cast<std::size_t>(part - plot.parts.begin()),
                                      fmt::format("{}, {}: {} ms", label, pass.name, msText(pass.ms))});
                from += pass.ms;
            }
            panel.pointsOf("frame: median, range", {}, false)
                .push_back({row[Measure::ms],
                            (up.low + up.high) / 2,
                            fmt::format("{}: {} ms", label, describeTime(row)),
                            {row[Measure::ms_min], row[Measure::ms_max]}});
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

}  // namespace

std::string benchPlot(const Bench& bench, PlotTarget target) {
    if (bench.options.table == BenchTable::growth) return svgOf(growthPlot(bench), target);
    if (bench.options.table == BenchTable::layers) return svgOf(layersPlot(bench), target);
    std::vector<Size> sizes;
    std::set<double> counts;
    for (const BenchRow& row : bench.rows) {
        if (std::ranges::count(sizes, row.settings.size) == 0) sizes.push_back(row.settings.size);
        counts.insert(row[Measure::lights]);
    }
    return svgOf(counts.size() > 1 ? modesPlot(bench, sizes) : barsPlot(bench, sizes), target);
}

}  // namespace diptych::bench
