// SPDX-License-Identifier: MIT
#include "compare/bench/layer_table.h"
#include "compare/bench/plot_parts.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {
namespace {

// Two panels side by side, in SVG user units.
constexpr double coverHeight = 260, coverTop = 50, coverBottom = 56, coverGap = 66;

// CSS class of a way's line: the two of deferred differ in colour.
const char* styleOf(std::size_t way) {
    return layerWays.at(way).layers == Layers::forward ? "layers" : "clustered";
}

// Rows of a kind, and without layers, under one light count.
std::vector<LayerRow> rowsOfPanel(const std::vector<LayerRow>& all, std::string_view kind,
                                  std::uint64_t lights) {
    std::vector<LayerRow> rows;
    for (const LayerRow& row : all)
        if (row.lights == lights && (row.cover.kind.empty() || row.cover.kind == kind)) rows.push_back(row);
    return rows;
}

// Shares stand at even distances.
std::string coverPanel(const std::vector<LayerRow>& rows, const std::string& title, const PlotBox& box) {
    std::vector<double> ms;
    std::vector<Tick> shares;
    for (const LayerRow& row : rows) {
        shares.push_back({static_cast<double>(shares.size()), fmt::format("{}", row.cover.percent)});
        for (const BenchRow* const way : row.ways)
            if (way != nullptr) ms.push_back(way->time.median);
    }
    const LogAxis up(ms);
    const auto x = [&](double i) {
        return box.left + (i + 0.5) / static_cast<double>(rows.size()) * (box.right - box.left);
    };
    const auto y = [&](double t) { return box.bottom - up.place(t) * (box.bottom - box.top); };
    Drawing drawing;
    drawing.axes(box, {shares, x, "covered, %"}, {up.ticks(), y, ""});
    drawing.text("name", box.left, box.top - 16, title);
    std::string out = drawing.group();
    for (std::size_t way = 0; way < layerWays.size(); ++way) {
        std::vector<PlotPoint> points;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (const BenchRow* const timed = rows[i].ways.at(way))
                points.push_back({x(static_cast<double>(i)), y(timed->time.median),
                                  fmt::format("{}, {}: {} ms", layerWays.at(way).name(),
                                              coverName(rows[i].cover), timeInWords(timed->time))});
        if (!points.empty()) out += traceOf(layerWays.at(way).path(), styleOf(way), points);
    }
    return out;
}

template <class T>
void addOnce(std::vector<T>& values, const T& value) {
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

}  // namespace

std::string layersPlot(const Bench& bench, PlotPlace place) {
    const std::vector<LayerRow> rows = layerRows(bench);
    std::vector<std::string_view> kinds;
    std::vector<std::uint64_t> counts;
    for (const LayerRow& row : rows) {
        if (!row.cover.kind.empty()) addOnce(kinds, row.cover.kind);
        addOnce(counts, row.lights);
    }
    const double width = (plotWidth - plotRight - plotLeft - coverGap) / 2;
    std::string out;
    std::size_t panels = 0;
    for (const std::uint64_t lights : counts)
        for (const std::string_view kind : kinds) {
            const double left = plotLeft + static_cast<double>(panels % 2) * (width + coverGap),
                         above = static_cast<double>(panels / 2) * coverHeight;
            out += coverPanel(rowsOfPanel(rows, kind, lights),
                              fmt::format("{}, {}: ms", kind, counted(lights, "light")),
                              {left, above + coverTop, left + width, above + coverHeight - coverBottom});
            ++panels;
        }
    Legend legend(static_cast<double>((panels + 1) / 2) * coverHeight + 4);
    for (std::size_t way = 0; way < layerWays.size(); ++way)
        out += legendOf(legend, layerWays.at(way).path(), styleOf(way), layerWays.at(way).name());
    return plotElement(plotWidth, legend.end(), "Time of a frame by what layers cover", place, out);
}

}  // namespace diptych::bench
