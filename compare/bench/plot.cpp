// SPDX-License-Identifier: MIT
// Plots of a benchmark. Lengths are in SVG user units.
#include "compare/bench/findings.h"
#include "compare/page/text.h"
#include "compare/plot/error_over_time.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::bench {
namespace {

constexpr double plotWidth = 720, plotLeft = 74, plotRight = plotWidth - 24, titleLeft = 10;
constexpr double entryHeight = 26;                 // legend
constexpr double panelTop = 50, panelBottom = 56;  // title; ticks and axis title
constexpr double headHeight = 34, rowHeight = 52;  // bars: title; bar with its label
constexpr double barHeight = 20, belowBars = 62;   // bar; ticks and axis title
constexpr std::size_t mostColours = 8;             // of plot.css; other passes are merged

// Two columns below the plot. Beside it, names would not fit on a phone, where text is larger in user units.
class Legend {
public:
    explicit Legend(double top) : top_(top) {}
    // Left end of the next entry's symbol, 24 wide, and its vertical centre.
    std::pair<double, double> next() {
        const int entry = entries_++;
        return {plotLeft + (entry % 2) * (plotWidth - plotLeft) / 2, top_ + (entry / 2 + 0.5) * entryHeight};
    }
    double end() const { return top_ + (entries_ + 1) / 2 * entryHeight + 16; }

private:
    double top_;
    int entries_ = 0;
};

// Text of the entry whose symbol is at x, y.
std::string legendText(double x, double y, const std::string& text) {
    return fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text>", svgNumber(x + 30),
                       svgNumber(y + 5), page::markup(text));
}

struct PlotPoint {
    double x, y;
    std::string title;
    double low = 0, high = 0;  // ends of a bar, up; equal: none
};
// Points joined by a line. Paths differ in the shape of markers and the dashes of lines.
struct PlotLine {
    Path path;
    std::string style;  // CSS classes besides the path's
    std::string name;   // in the legend
    std::vector<PlotPoint> points{};

    std::string classes() const { return fmt::format("series {} {}", nameOf(path), style); }
};

// Lines over logarithmic axes. `places`: x has these ticks at even distances instead, from 0.
struct LinePanel {
    std::string title, across;
    std::vector<PlotLine> lines{};
    std::vector<std::string> places{};
};

std::string panelOf(const LinePanel& panel, const PlotBox& box) {
    std::vector<double> xs, ys;
    for (const PlotLine& line : panel.lines)
        for (const PlotPoint& point : line.points) {
            xs.push_back(point.x);
            ys.push_back(point.y);
            if (point.low < point.high) ys.insert(ys.end(), {point.low, point.high});
        }
    const LogAxis across(xs), up(ys);
    const auto count = static_cast<double>(panel.places.size());
    const auto x = [&](double value) {
        const double at = panel.places.empty() ? across.place(value) : (value + 0.5) / count;
        return box.left + at * (box.right - box.left);
    };
    const auto y = [&](double value) { return box.bottom - up.place(value) * (box.bottom - box.top); };
    std::vector<Tick> ticks = panel.places.empty() ? across.ticks() : std::vector<Tick>();
    for (const std::string& place : panel.places) ticks.push_back({static_cast<double>(ticks.size()), place});
    Drawing drawing;
    drawing.axes(box, {ticks, x, panel.across}, {up.ticks(), y, ""});
    drawing.text("name", box.left, box.top - 16, panel.title);
    std::string out = drawing.group();
    for (const PlotLine& line : panel.lines) {
        std::string trace, marks;
        for (const PlotPoint& point : line.points) {
            const double px = x(point.x), py = y(point.y);
            trace += fmt::format("{}{} {}", trace.empty() ? "M" : "L", svgNumber(px), svgNumber(py));
            marks += fmt::format("<g><title>{}</title>", page::markup(point.title));
            if (point.low < point.high)
                marks += fmt::format("<path class=\"bar\" d=\"M{} {}V{}\"/>", svgNumber(px),
                                     svgNumber(y(point.low)), svgNumber(y(point.high)));
            marks += pathMark(line.path, px, py, 4) + "</g>";
        }
        out += fmt::format("<g class=\"{}\"><path class=\"trace\" d=\"{}\"/>{}</g>", line.classes(), trace,
                           marks);
    }
    return out;
}

// Panels in this number of columns, each `height` high, and a legend of all their lines.
std::string linesPlot(const std::vector<LinePanel>& panels, std::size_t columns, double height,
                      const std::string& title, PlotPlace place) {
    constexpr double gap = 66;
    const double width = (plotRight - plotLeft + gap) / static_cast<double>(columns);
    std::string out;
    for (std::size_t n = 0; n < panels.size(); ++n) {
        const double left = plotLeft + static_cast<double>(n % columns) * width,
                     top = static_cast<double>(n / columns) * height;
        out += panelOf(panels[n], {left, top + panelTop, left + width - gap, top + height - panelBottom});
    }
    Legend legend(static_cast<double>((panels.size() + columns - 1) / columns) * height + 4);
    std::set<std::string> named;
    for (const LinePanel& panel : panels)
        for (const PlotLine& line : panel.lines) {
            if (!named.insert(line.name).second) continue;
            const auto [x, y] = legend.next();
            out += fmt::format("<g class=\"{}\"><path class=\"trace\" d=\"M{} {}h24\"/>{}{}</g>",
                               line.classes(), svgNumber(x), svgNumber(y), pathMark(line.path, x + 12, y, 4),
                               legendText(x, y, line.name));
        }
    return plotElement(plotWidth, legend.end(), title, place, out);
}

// Time over light count: a panel per size, a line per mode.
std::string modesPlot(const Bench& bench, const std::vector<Size>& sizes, PlotPlace place) {
    std::vector<LinePanel> panels;
    for (const Size& size : sizes) {
        LinePanel& panel = panels.emplace_back(LinePanel{
            fmt::format("{}x{}, {}: ms", size.width, size.height, bench.scene), "lights in the scene"});
        for (const BenchRow& row : bench.rows) {
            if (row.settings.size != size) continue;
            const std::string name = row.label();
            auto line = std::ranges::find(panel.lines, name, &PlotLine::name);
            if (line == panel.lines.end())
                line = panel.lines.insert(
                    line, {row.settings.path, std::string(nameOf(row.settings.assign)), name});
            line->points.push_back({row[Measure::lights], row[Measure::ms],
                                    fmt::format("{}, {}: {} ms", name, row.lightsInWords(), timeInWords(row)),
                                    row[Measure::ms_min], row[Measure::ms_max]});
        }
        for (PlotLine& line : panel.lines) std::ranges::stable_sort(line.points, {}, &PlotPoint::x);
    }
    return linesPlot(panels, 1, 390, "Time against light count, " + bench.scene, place);
}

// Time and memory of each axis, a line per path.
std::string growthPlot(const Bench& bench, PlotPlace place) {
    std::map<GrowthAxis, std::vector<GrowthLine>> axes;
    for (const GrowthLine& line : growthLines(bench)) axes[line.axis].push_back(line);
    std::vector<LinePanel> panels;
    for (const auto& [axis, lines] : axes)
        for (const auto& [title, amountOf] :
             {std::pair{"time of a frame, ms", +[](const BenchRow& row) { return row[Measure::ms]; }},
              {"memory on the device, MiB", &memoryMib}}) {
            LinePanel& panel = panels.emplace_back(
                LinePanel{title, axis == GrowthAxis::textures ? "textures, MiB" : std::string(nameOf(axis))});
            for (const GrowthLine& line : lines) {
                PlotLine& drawn = panel.lines.emplace_back(
                    PlotLine{line.path, "clustered", std::string(nameOf(line.path))});
                for (const BenchRow* row : line.rows)
                    drawn.points.push_back(
                        {row->growth->value, amountOf(*row),
                         fmt::format("{}, {}: {:.4g}", drawn.name, row->point(), amountOf(*row))});
            }
        }
    return linesPlot(panels, 2, 260, "How a frame's time and memory grow", place);
}

// Time over the covered share: a panel per light count and kind, a line per way. Rows without layers are in
// each. Shares stand at even distances.
std::string layersPlot(const Bench& bench, PlotPlace place) {
    const std::vector<LayerRow> rows = layerRows(bench);
    std::vector<std::string_view> kinds;  // in the table's order
    std::set<std::uint64_t> counts;
    for (const LayerRow& row : rows) {
        if (!row.cover.kind.empty() && std::ranges::count(kinds, row.cover.kind) == 0)
            kinds.push_back(row.cover.kind);
        counts.insert(row.lights);
    }
    std::vector<LinePanel> panels;
    for (const std::uint64_t lights : counts)
        for (const std::string_view kind : kinds) {
            LinePanel& panel = panels.emplace_back(
                LinePanel{fmt::format("{}, {}: ms", kind, counted(lights, "light")), "covered, %"});
            for (const LayerWay& way : layerWays)  // the two of deferred differ in colour
                panel.lines.push_back(
                    {way.path(), way.layers == Layers::forward ? "layers" : "clustered", way.name()});
            for (const LayerRow& row : rows) {
                if (row.lights != lights || !(row.cover.kind.empty() || row.cover.kind == kind)) continue;
                for (std::size_t way = 0; way < layerWays.size(); ++way)
                    if (const BenchRow* const timed = row.ways.at(way))
                        panel.lines[way].points.push_back(
                            {static_cast<double>(panel.places.size()), (*timed)[Measure::ms],
                             fmt::format("{}, {}: {} ms", panel.lines[way].name, coverName(row.cover),
                                         timeInWords(*timed))});
                panel.places.push_back(fmt::format("{}", row.cover.percent));
            }
            std::erase_if(panel.lines, [](const PlotLine& line) { return line.points.empty(); });
        }
    return linesPlot(panels, 2, 260, "Time of a frame by what layers cover", place);
}

// Passes in order. If there are more than colours, the longest ones and one merged entry.
std::vector<std::string> passNames(const std::vector<BenchRow>& rows) {
    std::vector<std::string> names;
    std::map<std::string, double> most;
    for (const BenchRow& row : rows)
        for (const PassTime& pass : row.passes) {
            if (!most.contains(pass.name)) names.push_back(pass.name);
            most[pass.name] = std::max(most[pass.name], pass.ms);
        }
    if (names.size() <= mostColours) return names;
    std::vector<double> times;
    for (const auto& [name, ms] : most) times.push_back(ms);
    std::ranges::sort(times, std::greater<>());
    std::erase_if(names, [&](const std::string& name) { return most[name] <= times[mostColours - 1]; });
    names.emplace_back("other passes");
    return names;
}

// 1, 2 or 5 times a power of ten, for four to nine ticks up to `most`.
double stepOf(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most / 4)));
    const double share = most / 4 / power;
    return power * (share < 2 ? 1 : share < 5 ? 2 : 5);
}

// One bar per row of the size, stacked by the median times of its passes. Marks the median of whole frames
// and their range. Lengths are linear in time. `y` moves below them.
std::string barsOf(const Bench& bench, const Size& size, const std::vector<std::string>& names, double& y) {
    std::vector<const BenchRow*> rows;
    double most = 0;
    for (const BenchRow& row : bench.rows) {
        if (row.settings.size != size) continue;
        rows.push_back(&row);
        most = std::max({most, passMs(row), row[Measure::ms_max]});
    }
    if (!(most > 0)) most = 1;
    const auto partOf = [&](const std::string& pass) {
        return std::min(std::ranges::find(names, pass), std::prev(names.end())) - names.begin();
    };
    const double top = y + headHeight, bottom = top + rowHeight * static_cast<double>(rows.size());
    const auto x = [&](double ms) { return plotLeft + ms / most * (plotRight - plotLeft); };
    Drawing drawing;
    drawing.text(
        "name", titleLeft, top - 12,
        fmt::format("{}x{}, {}, {}", size.width, size.height, rows.front()->lightsInWords(), bench.scene));
    const double step = stepOf(most);
    for (double tick = 0; tick <= most; tick += step) {
        drawing.line("grid", x(tick), top, x(tick), bottom);
        drawing.text("tick middle", x(tick), bottom + 20, fmt::format("{:.6g}", tick));
    }
    drawing.line("axis", plotLeft, bottom, plotRight, bottom);
    drawing.text("name middle", (plotLeft + plotRight) / 2, bottom + 47,
                 "passes of a profiled frame, one after the other, ms");
    y = top + rowHeight - barHeight - 8;
    for (const BenchRow* row : rows) {
        const std::string label = row->label();
        drawing.text("tick", plotLeft, y - 6, fmt::format("{}: {} ms", label, msText((*row)[Measure::ms])));
        double from = 0;
        for (const PassTime& pass : row->passes) {
            drawing.add(fmt::format(
                "<rect class=\"part part{}\" x=\"{}\" y=\"{}\" width=\"{:.2f}\" "
                "height=\"{}\"><title>{}</title></rect>",
                partOf(pass.name), svgNumber(x(from)), svgNumber(y), x(pass.ms) - plotLeft, barHeight,
                page::markup(fmt::format("{}, {}: {} ms", label, pass.name, msText(pass.ms)))));
            from += pass.ms;
        }
        drawing.line("frame", x((*row)[Measure::ms_min]), y + barHeight / 2, x((*row)[Measure::ms_max]),
                     y + barHeight / 2);
        drawing.line("frame", x((*row)[Measure::ms]), y - 2, x((*row)[Measure::ms]), y + barHeight + 2);
        y += rowHeight;
    }
    y = bottom + belowBars;
    return drawing.group();
}

std::string barsPlot(const Bench& bench, const std::vector<Size>& sizes, PlotPlace place) {
    const std::vector<std::string> names = passNames(bench.rows);
    std::string out;
    double end = 0;
    for (const Size& size : sizes) out += barsOf(bench, size, names, end);
    Legend legend(end);
    for (std::size_t part = 0; part < names.size(); ++part) {
        const auto [x, y] = legend.next();
        out += fmt::format("<rect class=\"part part{}\" x=\"{}\" y=\"{}\" width=\"24\" height=\"14\"/>{}",
                           part, svgNumber(x), svgNumber(y - 7), legendText(x, y, names[part]));
    }
    const auto [x, y] = legend.next();
    out += fmt::format("<path class=\"frame\" d=\"M{0} {2}H{1}M{3} {4}V{5}\"/>{6}", svgNumber(x),
                       svgNumber(x + 24), svgNumber(y), svgNumber(x + 12), svgNumber(y - 8), svgNumber(y + 8),
                       legendText(x, y, "frame: median, range"));
    return plotElement(plotWidth, legend.end(), "Time by pass, " + bench.scene, place, out);
}

}  // namespace

std::string benchPlot(const Bench& bench, PlotPlace place) {
    if (bench.options.table == BenchTable::growth) return growthPlot(bench, place);
    if (bench.options.table == BenchTable::layers) return layersPlot(bench, place);
    std::vector<Size> sizes;
    std::set<double> counts;
    for (const BenchRow& row : bench.rows) {
        if (std::ranges::count(sizes, row.settings.size) == 0) sizes.push_back(row.settings.size);
        counts.insert(row[Measure::lights]);
    }
    return counts.size() > 1 ? modesPlot(bench, sizes, place) : barsPlot(bench, sizes, place);
}

}  // namespace diptych::bench
