// SPDX-License-Identifier: MIT
#include "compare/plot/plot.h"

#include "compare/page/emitted.h"
#include "compare/page/text.h"
#include "compare/plot/axis.h"
#include "compare/plot/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych {

using page::markup;

namespace {

constexpr double plotWidth = 720, plotLeft = 74, plotRight = plotWidth - 24;
constexpr double columnGap = 66;                   // columns of panels, for the ticks of the right one
constexpr double above = 40, below = 56;           // a panel's box: its name; ticks and the other axis' name
constexpr double nameLeft = 64;                    // from the box to the left of its name
constexpr double categoryHeight = 52;              // upwards: a category's name and its bar
constexpr double keyHeight = 26, keyWidth = 24;    // of the legend: a line, a symbol
constexpr std::size_t shortName = 26;              // letters that fit in half of the legend
constexpr double labelHeight = 17, farLabel = 40;  // farLabel: from the point to its label's centre

// A length with one decimal digit.
std::string length(double of) {
    return fmt::format("{:.1f}", of);
}

std::string line(std::string_view kind, double x1, double y1, double x2, double y2) {
    return fmt::format("<path class=\"{}\" d=\"M{} {}L{} {}\"/>", kind, length(x1), length(y1), length(x2),
                       length(y2));
}

std::string text(std::string_view kind, double x, double y, const std::string& sentence) {
    if (sentence.empty()) return {};
    return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>", kind, length(x), length(y),
                       markup(sentence));
}

std::string rect(const std::string& kind, double left, double top, double right, double bottom,
                 const std::string& sentence = {}) {
    const std::string title = sentence.empty() ? "" : "<title>" + markup(sentence) + "</title>";
    return fmt::format("<rect class=\"{}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\">{}</rect>",
                       kind, left, length(top), right - left, length(bottom - top), title);
}

// Paths differ in the shape of marks. `r`: radius.
std::string markOf(std::optional<Path> path, double x, double y, double r) {
    if (!path) return rect("mark", x - 1, y - 3 * r, x + 1, y + 3 * r);
    if (hasGBuffer(*path))
        return fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", length(x), length(y),
                           length(r));
    if (shadesFragments(*path)) return rect("mark", x - 0.9 * r, y - 0.9 * r, x + 0.9 * r, y + 0.9 * r);
    return fmt::format("<path class=\"mark\" d=\"M{} {}l{r} {r}l-{r} {r}l-{r} -{r}z\"/>", length(x),
                       length(y - 1.2 * r), fmt::arg("r", length(1.2 * r)));
}

std::string partClass(const PlotBar& bar) {
    return bar.beyond ? "part past" : fmt::format("part part{}", std::min(bar.part, maxParts - 1));
}

const char* limitClass(const PlotLimit& limit) {
    return limit.strict ? "budget" : "usual";
}

// The series of the legend, and their classes: those of one path differ.
struct Styles {
    std::vector<const PlotSeries*> entries{};

    std::string of(const PlotSeries& series) const {
        const auto entry = std::ranges::find(entries, series.name, &PlotSeries::name);
        return fmt::format("series {} v{}", series.path ? nameOf(*series.path) : "all",
                           std::ranges::count(entries.begin(), entry, series.path, &PlotSeries::path) % 6);
    }
};

// One panel inside `box`.
class Panel {
public:
    Panel(const Plot& plot, const PlotPanel& panel, const Styles& styles, const PlotBox& box,
          PlotTarget target)
        : plot_(plot),
          panel_(panel),
          styles_(styles),
          box_(box),
          file_(target == PlotTarget::file),
          across_(panel.across, values(&PlotPoint::x), others(true), box.left, box.right, false),
          up_(panel.up, values(&PlotPoint::y), others(false),
              panel.up.categories.empty() ? box.bottom : box.top,
              panel.up.categories.empty() ? box.top : box.bottom, true) {}

    std::string svg() const {
        std::string out = axes();
        for (const PlotBar& bar : panel_.bars)
            out += rect(partClass(bar), across_.at(bar.across.low),
                        std::min(up_.at(bar.up.low), up_.at(bar.up.high)), across_.at(bar.across.high),
                        std::max(up_.at(bar.up.low), up_.at(bar.up.high)), bar.text);
        for (const PlotLimit& limit : panel_.limits) {
            if (limit.x)
                out += line(limitClass(limit), across_.at(*limit.x), box_.top, across_.at(*limit.x),
                            box_.bottom);
            if (limit.y)
                out += line(limitClass(limit), box_.left, up_.at(*limit.y), box_.right, up_.at(*limit.y));
        }
        out += front();
        // The first of overlapping series is on top.
        for (const bool best : {false, true})
            for (std::size_t i = panel_.series.size(); i-- > 0;) out += seriesOf(panel_.series[i], best);
        return out + labels();
    }

private:
    std::vector<double> values(double PlotPoint::*of) const {
        std::vector<double> all;
        for (const PlotSeries& series : panel_.series)
            for (const PlotPoint& point : series.points) all.push_back(point.*of);
        return all;
    }
    std::vector<double> others(bool across) const {
        std::vector<double> all;
        const auto add = [&](const PlotRange& range) {
            if (range.low < range.high) all.insert(all.end(), {range.low, range.high});
        };
        for (const PlotSeries& series : panel_.series)
            for (const PlotPoint& point : series.points) add(across ? point.across : point.up);
        for (const PlotBar& bar : panel_.bars) add(across ? bar.across : bar.up);
        return all;
    }

    // The vertical axis is named above it: a rotated name beside it would collide with the ticks if text is
    // large. The names of its categories are inside, above bars.
    std::string axes() const {
        std::map<std::string_view, std::string> lines;  // by kind
        std::string out, texts;
        const auto to = [](double x, double y, double to_x, double to_y) {
            return fmt::format("M{} {}L{} {}", length(x), length(y), length(to_x), length(to_y));
        };
        for (const PlotTick& tick : across_.ticks()) {
            lines[tick.kind] += to(tick.line, box_.top, tick.line, box_.bottom);
            texts += text("tick middle", tick.at, box_.bottom + 20, tick.text);
        }
        const bool categorical = !panel_.up.categories.empty();
        for (const PlotTick& tick : up_.ticks()) {
            if (!categorical) lines[tick.kind] += to(box_.left, tick.line, box_.right, tick.line);
            texts += categorical ? text("tick", box_.left + 4, tick.at - 8, tick.text)
                                 : text("tick end", box_.left - 8, tick.at + 4, tick.text);
        }
        for (const auto& [kind, path] : lines)
            out += fmt::format("<path class=\"{}\" d=\"{}\"/>", kind, path);
        return out +
               fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>", length(box_.left),
                           length(box_.top), length(box_.bottom), length(box_.right)) +
               texts +
               text("name middle", (box_.left + box_.right) / 2, box_.bottom + 47, panel_.across.name) +
               text("name", box_.left - nameLeft, box_.top - 14, panel_.up.name);
    }

    std::string front() const {
        std::vector<std::pair<double, double>> points = panel_.front;
        std::ranges::sort(points);
        std::string path;
        for (const auto& [x, y] : points)
            path += path.empty()
                        ? fmt::format("M{} {}V{}", length(across_.at(x)), length(box_.top), length(up_.at(y)))
                        : fmt::format("H{}V{}", length(across_.at(x)), length(up_.at(y)));
        if (path.empty()) return {};
        return fmt::format("<path class=\"front\" d=\"{}H{}\"/>", path, length(box_.right));
    }

    // Its best points, or its line and the others.
    std::string seriesOf(const PlotSeries& series, bool best) const {
        std::string points, trace;
        for (const PlotPoint& point : series.points) {
            if (point.best == best) points += pointOf(series, point);
            trace += fmt::format("{}{} {}", trace.empty() ? "M" : "L", length(across_.at(point.x)),
                                 length(up_.at(point.y)));
        }
        if (!best && series.line && !trace.empty())
            points = fmt::format("<path class=\"trace\" d=\"{}\"/>", trace) + points;
        if (points.empty()) return {};
        return fmt::format("<g class=\"{}\">{}</g>", styles_.of(series), points);
    }

    std::string pointOf(const PlotSeries& series, const PlotPoint& point) const {
        const double x = across_.at(point.x), y = up_.at(point.y);
        const std::string sentence = markup(point.text);
        std::string out = point.best ? "<g class=\"point best\"" : "<g class=\"point\"";
        if (point.row > 0) out += fmt::format(" data-row=\"{}\"", point.row);
        if (point.row > 0 && !file_)
            out += fmt::format(" tabindex=\"0\" role=\"{}\" aria-label=\"{}\"",
                               plot_.chooses ? "button" : "img", sentence);
        out += ">";
        if (file_ || !plot_.chooses) out += "<title>" + sentence + "</title>";
        std::string bars;
        if (point.across.low < point.across.high)
            bars += line("bar", across_.at(point.across.low), y, across_.at(point.across.high), y);
        if (point.up.low < point.up.high)
            bars += line("bar", x, up_.at(point.up.low), x, up_.at(point.up.high));
        out += bars + markOf(series.path, x, y, point.best ? 6 : 4);
        if (point.row > 0)
            out += fmt::format("<circle class=\"hit\" cx=\"{}\" cy=\"{}\" r=\"11\"/>", length(x), length(y));
        return out + "</g>";
    }

    // A line connects a label with its point if it is far away or closer to another.
    std::string labels() const {
        std::vector<Label> labels;
        std::vector<std::string> texts;
        std::vector<PlotBox> marks;
        for (const PlotSeries& series : panel_.series)
            for (const PlotPoint& point : series.points) {
                const double x = across_.at(point.x), y = up_.at(point.y);
                marks.push_back({x - 5, y - 5, x + 5, y + 5});
                if (point.label.empty()) continue;
                labels.push_back({x, y, plotLetter * static_cast<double>(point.label.size()), labelHeight});
                texts.push_back(point.label);
            }
        const std::vector<PlotBox> label_boxes = positionLabels(labels, marks, box_);
        std::string out;
        for (std::size_t i = 0; i < label_boxes.size(); ++i) {
            const double x = (label_boxes[i].left + label_boxes[i].right) / 2,
                         y = (label_boxes[i].top + label_boxes[i].bottom) / 2;
            const double own = std::hypot(x - labels[i].x, y - labels[i].y);
            const bool misread = std::ranges::any_of(marks, [&](const PlotBox& m) {
                return std::hypot(x - (m.left + m.right) / 2, y - (m.top + m.bottom) / 2) < own - 1e-6;
            });
            if (own > farLabel || misread) out += line("lead", labels[i].x, labels[i].y, x, y);
            out += text("row middle", x, label_boxes[i].bottom - 3, texts[i]);
        }
        return out.empty() ? out : "<g class=\"rows-named\">" + out + "</g>";
    }

    const Plot& plot_;
    const PlotPanel& panel_;
    const Styles& styles_;
    const PlotBox box_;
    const bool file_;
    const Axis across_, up_;
};

// Below the plot, in two columns if all names are short. Beside it, names would not fit on a phone, where
// text is larger in user units. Moves `top` below it.
std::string legendOf(const Plot& plot, const Styles& styles, double& top) {
    std::vector<std::pair<std::string, std::string>> entries;  // names and symbols, each once
    const auto add = [&](const std::string& name, const std::string& kind, const std::string& symbol) {
        if (!name.empty() && std::ranges::count(entries, name, &decltype(entries)::value_type::first) == 0)
            entries.emplace_back(name,
                                 kind.empty() ? symbol : fmt::format("<g class=\"{}\">{}</g>", kind, symbol));
    };
    const auto addLine = [&](const std::string& name, const char* kind) {
        add(name, "point", line(kind, 0, 0, keyWidth, 0));
    };
    for (const PlotSeries* series : styles.entries)
        add(series->name, styles.of(*series),
            (series->line ? line("trace", 0, 0, keyWidth, 0) : "") +
                markOf(series->path, keyWidth / 2, 0, 4));
    for (std::size_t part = 0; part < plot.parts.size(); ++part)
        add(plot.parts[part], "", rect(partClass({{}, {}, part, {}}), 0, -7, keyWidth, 7));
    addLine(plot.interval, "bar");
    for (const PlotPanel& panel : plot.panels) {
        if (!panel.front.empty()) addLine("Pareto front", "front");
        for (const PlotLimit& limit : panel.limits)
            add(limit.name, "", line(limitClass(limit), 0, 0, keyWidth, 0));
    }
    const bool narrow =
        std::ranges::all_of(entries, [](const auto& entry) { return entry.first.size() <= shortName; });
    std::string out;
    double x = plotLeft;
    for (const auto& [name, symbol] : entries) {
        out += fmt::format("<g transform=\"translate({} {})\">{}{}</g>", length(x),
                           length(top + keyHeight / 2), symbol, text("tick", keyWidth + 6, 5, name));
        x = narrow && x == plotLeft ? (plotLeft + plotWidth) / 2 : plotLeft;
        if (x == plotLeft) top += keyHeight;
    }
    if (x > plotLeft) top += keyHeight;
    top += 12;
    return out;
}

}  // namespace

std::vector<PlotPoint>& PlotPanel::pointsOf(const std::string& name, std::optional<Path> path, bool line) {
    const auto found = std::ranges::find(series, name, &PlotSeries::name);
    return (found == series.end() ? series.emplace_back(PlotSeries{name, path, line}) : *found).points;
}

std::string svgOf(const Plot& plot, PlotTarget target) {
    Styles styles;
    for (const PlotPanel& panel : plot.panels)
        for (const PlotSeries& series : panel.series)
            if (std::ranges::count(styles.entries, series.name, &PlotSeries::name) == 0)
                styles.entries.push_back(&series);
    const double width = (plotRight - plotLeft + columnGap) / static_cast<double>(plot.columns);
    std::string inside;
    double top = 0, next = 0;
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const PlotPanel& panel = plot.panels[i];
        const std::size_t column = i % plot.columns;
        if (column == 0) top = next;
        const double left = plotLeft + static_cast<double>(column) * width;
        const double inner = panel.up.categories.empty()
                                 ? plot.height - above - below
                                 : categoryHeight * static_cast<double>(panel.up.categories.size());
        const PlotBox box{left, top + above, left + width - columnGap, top + above + inner};
        inside += Panel(plot, panel, styles, box, target).svg();
        next = std::max(next, box.bottom + below);
    }
    inside += legendOf(plot, styles, next);
    const bool file = target == PlotTarget::file;
    const std::string title = markup(plot.title);
    return fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" {}role=\"{}\" aria-label=\"{}\">{}{}"
        "</svg>\n",
        plotWidth, next, file ? "xmlns=\"http://www.w3.org/2000/svg\" " : "", file ? "img" : "group", title,
        file ? fmt::format("<title>{}</title><style>{}</style><rect class=\"paper\" "
                           "width=\"100%\" height=\"100%\"/>",
                           title, plotStyle)
             : "",
        inside);
}

void checkPlot(std::string svg) {
    const std::string style = fmt::format("<style>{}</style>", plotStyle);
    if (const std::size_t at = svg.find(style); at != svg.npos) svg.erase(at, style.size());
    page::checkMarkup(svg);
}

}  // namespace diptych
