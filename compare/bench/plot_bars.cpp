// SPDX-License-Identifier: MIT
#include "compare/bench/plot_parts.h"
#include "compare/page/text.h"
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

std::string traceOf(Path path, std::string_view style, const std::vector<PlotPoint>& points) {
    std::string line, marks;
    for (const PlotPoint& at : points) {
        line += fmt::format("{}{} {}", line.empty() ? "M" : "L", svgNumber(at.x), svgNumber(at.y));
        marks += fmt::format("<g><title>{}</title>{}</g>", page::markup(at.title), markAt(path, at.x, at.y));
    }
    return fmt::format("<g class=\"series {} {}\"><path class=\"trace\" d=\"{}\"/>{}</g>", nameOf(path),
                       style, line, marks);
}

std::string legendOf(Legend& legend, Path path, std::string_view style, const std::string& name) {
    const auto [x, y] = legend.next();
    return fmt::format("<g class=\"series {} {}\"><path class=\"trace\" d=\"M{} {}h24\"/>{}{}</g>",
                       nameOf(path), style, svgNumber(x), svgNumber(y), markAt(path, x + 12, y),
                       legend.words(name));
}

Panel barsOf(const Bench& bench, const Size& size, double above) {
    std::vector<const BenchRow*> rows;
    double most = 0;
    for (const BenchRow& row : bench.rows) {
        if (row.settings.size != size) continue;
        rows.push_back(&row);
        double sum = 0;
        for (const PassTime& pass : row.passes) sum += pass.ms;
        most = std::max({most, sum, row.time.max});
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
                             counted(rows.front()->counters.lights, "light"), bench.scene));
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
        drawing.text("tick", plotLeft, y - 6, fmt::format("{}: {} ms", label, msText(row->time.median)));
        double from = 0;
        for (const PassTime& pass : row->passes) {
            drawing.add(fmt::format(
                "<rect class=\"part part{}\" x=\"{}\" y=\"{}\" width=\"{:.2f}\" "
                "height=\"{}\"><title>{}</title></rect>",
                partOf(pass.name), svgNumber(x(from)), svgNumber(y), x(pass.ms) - plotLeft, barHeight,
                page::markup(fmt::format("{}, {}: {} ms", label, pass.name, msText(pass.ms)))));
            from += pass.ms;
        }
        drawing.line("frame", x(row->time.min), y + barHeight / 2, x(row->time.max), y + barHeight / 2);
        drawing.line("frame", x(row->time.median), y - 2, x(row->time.median), y + barHeight + 2);
        y += rowHeight;
    }
    Legend legend(bottom + below);
    return {drawing.group() + entriesOf(names, legend), legend.end()};
}

}  // namespace diptych::bench
