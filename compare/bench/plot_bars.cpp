// SPDX-License-Identifier: MIT
#include "compare/bench/plot_parts.h"
#include "compare/page/text.h"
#include "compare/plot/error_over_time.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::bench {
namespace {

constexpr double entryHeight = 26;                 // legend
constexpr double headHeight = 34, rowHeight = 52;  // panel; bar with its label
constexpr double barHeight = 20, below = 62;       // bar; ticks and axis title
constexpr std::size_t mostColours = 8;             // of plot.css; other passes are merged
constexpr const char* otherPasses = "other passes";
constexpr double smallHeight = 260, smallTop = 50, smallBottom = 56, smallGap = 66;  // panels in pairs

// Passes in order. If there are more than colours, the longest ones and one merged entry.
std::vector<std::string> passNames(const std::vector<const BenchRow*>& rows) {
    std::vector<std::string> names;
    std::map<std::string, double> most;
    for (const BenchRow* row : rows)
        for (const PassTime& pass : row->passes) {
            if (!most.contains(pass.name)) names.push_back(pass.name);
            most[pass.name] = std::max(most[pass.name], pass.ms);
        }
    if (names.size() <= mostColours) return names;
    std::vector<double> times;
    for (const auto& [name, ms] : most) times.push_back(ms);
    std::ranges::sort(times, std::greater<>());
    std::erase_if(names, [&](const std::string& name) { return most[name] <= times[mostColours - 1]; });
    names.emplace_back(otherPasses);
    return names;
}

// 1, 2 or 5 times a power of ten, for four to nine ticks up to `most`.
double stepOf(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most / 4)));
    const double share = most / 4 / power;
    return power * (share < 2 ? 1 : share < 5 ? 2 : 5);
}

// Colours of the passes, and the mark of a whole frame.
std::string entriesOf(const std::vector<std::string>& names, Legend& legend) {
    std::string out;
    for (std::size_t part = 0; part < names.size(); ++part) {
        const auto [lx, ly] = legend.next();
        out += fmt::format("<rect class=\"part part{}\" x=\"{}\" y=\"{}\" width=\"24\" height=\"14\"/>{}",
                           part, svgNumber(lx), svgNumber(ly - 7), legend.words(names[part]));
    }
    const auto [lx, ly] = legend.next();
    return out + fmt::format("<path class=\"frame\" d=\"M{0} {2}H{1}M{3} {4}V{5}\"/>{6}", svgNumber(lx),
                             svgNumber(lx + 24), svgNumber(ly), svgNumber(lx + 12), svgNumber(ly - 8),
                             svgNumber(ly + 8), legend.words("frame: median, range"));
}

}  // namespace

std::pair<double, double> Legend::next() {
    const int entry = entries_++;
    return {plotLeft + (entry % 2) * (plotWidth - plotLeft) / 2, top_ + (entry / 2 + 0.5) * entryHeight};
}

std::string Legend::words(const std::string& text) const {
    const int entry = entries_ - 1;
    return fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text>",
                       svgNumber(plotLeft + (entry % 2) * (plotWidth - plotLeft) / 2 + 30),
                       svgNumber(top_ + (entry / 2 + 0.5) * entryHeight + 5), page::markup(text));
}

double Legend::end() const {
    return top_ + (entries_ + 1) / 2 * entryHeight + 16;
}

namespace {

std::string classesOf(const PlotLine& line) {
    return fmt::format("series {} {}", nameOf(line.path), line.style);
}

}  // namespace

std::string panelOf(const LinePanel& panel, const PlotBox& box, double title_left) {
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
    drawing.axes(box, {ticks, x, panel.across}, {up.ticks(), y, panel.up});
    drawing.text("name", title_left, box.top - (panel.up.empty() ? 16 : 38), panel.title);
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
        out += fmt::format("<g class=\"{}\"><path class=\"trace\" d=\"{}\"/>{}</g>", classesOf(line), trace,
                           marks);
    }
    return out;
}

std::string legendOf(Legend& legend, const PlotLine& line) {
    const auto [x, y] = legend.next();
    return fmt::format("<g class=\"{}\"><path class=\"trace\" d=\"M{} {}h24\"/>{}{}</g>", classesOf(line),
                       svgNumber(x), svgNumber(y), pathMark(line.path, x + 12, y, 4),
                       legend.words(line.name));
}

PlotBox smallBox(std::size_t n) {
    constexpr double width = (plotWidth - plotRight - plotLeft - smallGap) / 2;
    const double left = plotLeft + static_cast<double>(n % 2) * (width + smallGap),
                 above = static_cast<double>(n / 2) * smallHeight;
    return {left, above + smallTop, left + width, above + smallHeight - smallBottom};
}

double belowSmall(std::size_t panels) {
    return static_cast<double>((panels + 1) / 2) * smallHeight + 4;
}

Panel barsOf(const Bench& bench, const Size& size, double above) {
    std::vector<const BenchRow*> rows;
    double most = 0;
    for (const BenchRow& row : bench.rows) {
        if (row.settings.size != size) continue;
        rows.push_back(&row);
        double sum = 0;
        for (const PassTime& pass : row.passes) sum += pass.ms;
        most = std::max({most, sum, row[Measure::ms_max]});
    }
    if (!(most > 0)) most = 1;
    const std::vector<std::string> names = passNames(rows);
    const auto partOf = [&](const std::string& pass) {
        return static_cast<std::size_t>(std::min(std::ranges::find(names, pass), std::prev(names.end())) -
                                        names.begin());
    };
    const double bottom = above + headHeight + rowHeight * static_cast<double>(rows.size()),
                 right = plotWidth - plotRight;
    const auto x = [&](double ms) { return plotLeft + ms / most * (right - plotLeft); };
    Drawing drawing;
    drawing.text("name", plotTitleLeft, above + headHeight - 12,
                 fmt::format("{}x{}, {}, {}", size.width, size.height,
                             counted(rows.front()->whole(Measure::lights), "light"), bench.scene));
    const double step = stepOf(most);
    for (double tick = 0; tick <= most; tick += step) {
        drawing.line("grid", x(tick), above + headHeight, x(tick), bottom);
        drawing.text("tick middle", x(tick), bottom + 20, fmt::format("{:.6g}", tick));
    }
    drawing.line("axis", plotLeft, bottom, right, bottom);
    drawing.text("name middle", (plotLeft + right) / 2, bottom + 47,
                 "passes of a profiled frame, one after the other, ms");
    double y = above + headHeight + rowHeight - barHeight - 8;
    for (const BenchRow* row : rows) {
        const std::string label = modeLabel(row->settings.path, row->settings.assign, row->parts);
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
    Legend legend(bottom + below);
    return {drawing.group() + entriesOf(names, legend), legend.end()};
}

}  // namespace diptych::bench
