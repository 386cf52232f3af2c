// SPDX-License-Identifier: MIT
#include "compare/tradeoff/plot.h"

#include "compare/page/text.h"
#include "compare/plot/error_over_time.h"
#include "compare/plot/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::tradeoff {

using page::markup;
using page::number;

namespace {

// SVG user units.
constexpr double width = 720, height = 440, left = 74, right = 16, top = 32, bottom = 56;
constexpr double digitWidth = 11.5,
                 digitHeight = 17;  // of row numbers, at the style's largest text size
constexpr double farLabel = 40;     // from the point to its label's centre
constexpr PlotBox axesBox{left, top, width - right, height - bottom};

class Plot {
public:
    Plot(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path)
        : tradeoff_(tradeoff),
          figure_(figure),
          path_(path),
          rows_(rowsOf(tradeoff, path)),
          front_(frontOf(tradeoff, figure, path)),
          axes_(axesBox, timesOf(), errorsOf(), pointErrors()) {}

    std::string svg(PlotPlace place) const {
        const bool file = place == PlotPlace::file;
        const std::string title =
            fmt::format("{} over time, {}{}", errorFigures[figure_].title, tradeoff_.scene,
                        path_ ? ", " + std::string(nameOf(*path_)) : "");
        std::string out = axes_.axes(std::string(errorFigures[figure_].title)) + frontLine();
        for (const bool front : {false, true})  // front on top
            for (const std::size_t row : rows_)
                if ((std::ranges::count(front_, row) > 0) == front) out += point(row, front, file);
        out += rowNumbers();
        if (!path_) out += legend();
        return plotElement(width, height, title, place, out);
    }

private:
    std::vector<double> timesOf() const {
        std::vector<double> all;
        for (const std::size_t row : rows_) {
            const Spread time = timeOf(tradeoff_.rows[row]);
            all.insert(all.end(), {time.value, time.low, time.high});
        }
        return all;
    }
    std::vector<double> errorsOf() const {
        std::vector<double> all;
        for (const std::size_t row : rows_) {
            const Spread error = errorOf(tradeoff_.rows[row], figure_);
            all.insert(all.end(), {error.value, error.high});
            if (error.value > 0) all.push_back(error.low);
        }
        return all;
    }
    std::vector<double> pointErrors() const {
        std::vector<double> all;
        for (const std::size_t row : rows_) all.push_back(errorOf(tradeoff_.rows[row], figure_).value);
        return all;
    }
    double x(double time) const { return axes_.x(time); }
    double y(double error) const { return axes_.y(error); }

    std::string frontLine() const {
        std::vector<std::pair<double, double>> points;
        for (const std::size_t row : front_)
            points.emplace_back(timeOf(tradeoff_.rows[row]).value, tradeoff_.rows[row].errors[figure_]);
        return axes_.front(points);
    }

    std::string point(std::size_t index, bool front, bool file) const {
        const TradeoffRow& row = tradeoff_.rows[index];
        const Spread time = timeOf(row), error = errorOf(row, figure_);
        const double px = x(time.value), py = y(error.value);
        const std::string words = fmt::format(
            "row {}: {}; {:.4g} ms, {} {}{}", index + 1, inWords(choicesOf(row.settings, tradeoff_.given)),
            time.value, errorFigures[figure_].title, number(error.value), front ? ", on the front" : "");
        std::string out = fmt::format(
            "<g class=\"point {}{}\" data-row=\"{}\"{}>", nameOf(row.settings.path), front ? " best" : "",
            index + 1,
            file ? "" : fmt::format(" tabindex=\"0\" role=\"button\" aria-label=\"{}\"", markup(words)));
        if (file) out += "<title>" + markup(words) + "</title>";
        out += fmt::format("<path class=\"bar\" d=\"M{} {}H{}", svgNumber(x(time.low)), svgNumber(py),
                           svgNumber(x(time.high)));
        if (error.low < error.value || error.high > error.value)
            out += fmt::format("M{} {}V{}", svgNumber(px), svgNumber(y(error.low)), svgNumber(y(error.high)));
        return out + "\"/>" + pathMark(row.settings.path, px, py, front ? 6 : 4.5) +
               fmt::format("<circle class=\"hit\" cx=\"{}\" cy=\"{}\" r=\"11\"/></g>", svgNumber(px),
                           svgNumber(py));
    }

    // Numbers of the rows on the front, above all points. A line connects a label with its point if it is
    // far away or closer to another point.
    std::string rowNumbers() const {
        std::vector<Label> labels;
        std::vector<PlotBox> marks;
        for (const std::size_t index : rows_) {
            const double px = x(timeOf(tradeoff_.rows[index]).value),
                         py = y(errorOf(tradeoff_.rows[index], figure_).value);
            marks.push_back({px - 5, py - 5, px + 5, py + 5});
        }
        for (const std::size_t index : front_)
            labels.push_back(
                {x(timeOf(tradeoff_.rows[index]).value), y(tradeoff_.rows[index].errors[figure_]),
                 digitWidth * static_cast<double>(fmt::formatted_size("{}", index + 1)), digitHeight});
        const std::vector<PlotBox> places = placeLabels(labels, marks, axesBox);
        std::string out;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double px = (places[i].left + places[i].right) / 2,
                         py = (places[i].top + places[i].bottom) / 2;
            const double own = std::hypot(px - labels[i].x, py - labels[i].y);
            const bool misread = std::ranges::any_of(marks, [&](const PlotBox& m) {
                return std::hypot(px - (m.left + m.right) / 2, py - (m.top + m.bottom) / 2) < own - 1e-6;
            });
            if (own > farLabel || misread)
                out += fmt::format("<path class=\"lead\" d=\"M{} {}L{} {}\"/>", svgNumber(labels[i].x),
                                   svgNumber(labels[i].y), svgNumber(px), svgNumber(py));
            out += fmt::format("<text class=\"row middle\" x=\"{}\" y=\"{}\">{}</text>", svgNumber(px),
                               svgNumber(places[i].bottom - 3), front_[i] + 1);
        }
        return "<g class=\"rows-named\">" + out + "</g>";
    }

    std::string legend() const {
        std::string out;
        double px = width - right - 8;
        for (const Path path : pathsOf(tradeoff_)) {
            const std::string name(nameOf(path));
            px -= 10.0 * static_cast<double>(name.size()) + 22;
            out += fmt::format("<g class=\"point {}\">{}<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text></g>",
                               name, pathMark(path, px, top - 17, 4.5), svgNumber(px + 9),
                               svgNumber(top - 12), name);
        }
        return out;
    }

    const Tradeoff& tradeoff_;
    const std::size_t figure_;
    const std::optional<Path> path_;
    const std::vector<std::size_t> rows_, front_;
    const ErrorOverTime axes_;
};

}  // namespace

std::string tradeoffPlot(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path,
                         PlotPlace place) {
    return Plot(tradeoff, figure, path).svg(place);
}

std::string plotName(std::size_t figure, std::optional<Path> path) {
    const std::string_view name = errorFigures[figure].name;
    return path ? fmt::format("{}.{}.svg", name, nameOf(*path)) : fmt::format("{}.svg", name);
}

}  // namespace diptych::tradeoff
