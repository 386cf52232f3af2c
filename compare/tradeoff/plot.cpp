// SPDX-License-Identifier: MIT
#include "compare/tradeoff/plot.h"

#include "compare/page/text.h"
#include "compare/plot/drawing.h"
#include "compare/plot/labels.h"
#include "compare/plot/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::tradeoff {

using page::markup;
using page::number;

namespace {

// Of the drawing, in its own units.
constexpr double width = 720, height = 440, left = 74, right = 16, top = 32, bottom = 56;
constexpr double digitWidth = 11.5,
                 digitHeight = 17;  // of a row's number, where the style makes text largest
constexpr double farLabel = 40;     // from its point to the middle of its number
constexpr double lane = 26;  // the strip for errors that a logarithmic axis cannot show, 0 and infinity

class Plot {
public:
    Plot(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path)
        : tradeoff_(tradeoff),
          figure_(figure),
          path_(path),
          rows_(rowsOf(tradeoff, path)),
          front_(frontOf(tradeoff, figure, path)),
          time_(timesOf()),
          error_(errorsOf()) {
        for (const std::size_t row : rows_) {
            const double error = errorOf(tradeoff.rows[row], figure).value;
            zeros_ = zeros_ || !(error > 0);
            infinities_ = infinities_ || !std::isfinite(error);
        }
    }

    std::string svg(PlotPlace place) const {
        const bool file = place == PlotPlace::file;
        const std::string title =
            fmt::format("{} over time, {}{}", errorFigures[figure_].title, tradeoff_.scene,
                        path_ ? ", " + std::string(nameOf(*path_)) : "");
        std::string out = axes() + frontLine();
        for (const bool front : {false, true})  // the front on top
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
    double x(double time) const { return left + time_.place(time) * (width - left - right); }
    double y(double error) const {
        const double low = height - bottom - (zeros_ ? lane : 0), high = top + (infinities_ ? lane : 0);
        if (!(error > 0)) return zeros_ ? height - bottom - lane / 2 : low;
        if (!std::isfinite(error)) return top + lane / 2;
        return low - error_.place(error) * (low - high);
    }

    std::string axes() const {
        const double foot = height - bottom;
        Drawing drawing;
        drawing.axes(
            {left, top, width - right, foot}, time_.ticks(), [this](double ms) { return x(ms); },
            "time of a frame, ms", error_.ticks(), [this](double error) { return y(error); },
            std::string(errorFigures[figure_].title));
        if (zeros_) {
            drawing.line("gap", left, foot - lane, width - right, foot - lane);
            drawing.text("tick end", left - 8, y(0) + 4, "0");
        }
        if (infinities_) {
            drawing.line("gap", left, top + lane, width - right, top + lane);
            drawing.text("tick end", left - 8, top + lane / 2 + 4, "\u221e");
        }
        return drawing.group();
    }

    // The least error that is reached within a time: a step line, lower only from the next point on.
    std::string frontLine() const {
        if (front_.empty()) return {};
        std::string line;
        for (const std::size_t row : front_) {
            const double px = x(timeOf(tradeoff_.rows[row]).value),
                         py = y(tradeoff_.rows[row].errors[figure_]);
            line += line.empty() ? fmt::format("M{} {}V{}", svgNumber(px), svgNumber(top), svgNumber(py))
                                 : fmt::format("H{}V{}", svgNumber(px), svgNumber(py));
        }
        return fmt::format("<path class=\"front\" d=\"{}H{}\"/>", line, svgNumber(width - right));
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
        return out + "\"/>" + mark(row.settings.path, px, py, front ? 6 : 4.5) +
               fmt::format("<circle class=\"hit\" cx=\"{}\" cy=\"{}\" r=\"11\"/></g>", svgNumber(px),
                           svgNumber(py));
    }

    // The number of each row on the front, above all points; a line leads to one that had to go far, or
    // that stands nearer to another point than to its own.
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
        const std::vector<PlotBox> places =
            placeLabels(labels, marks, {left, top, width - right, height - bottom});
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

    // Paths differ in shape as well as in colour.
    static std::string mark(Path path, double px, double py, double r) {
        if (path == Path::deferred)
            return fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", svgNumber(px),
                               svgNumber(py), svgNumber(r));
        return fmt::format("<rect class=\"mark\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                           svgNumber(px - 0.9 * r), svgNumber(py - 0.9 * r), svgNumber(1.8 * r),
                           svgNumber(1.8 * r));
    }

    std::string legend() const {
        std::string out;
        double px = width - right - 8;
        for (const Path path : pathsOf(tradeoff_)) {
            const std::string name(nameOf(path));
            px -= 10.0 * static_cast<double>(name.size()) + 22;
            out += fmt::format("<g class=\"point {}\">{}<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text></g>",
                               name, mark(path, px, top - 17, 4.5), svgNumber(px + 9), svgNumber(top - 12),
                               name);
        }
        return out;
    }

    const Tradeoff& tradeoff_;
    const std::size_t figure_;
    const std::optional<Path> path_;
    const std::vector<std::size_t> rows_, front_;
    const LogAxis time_, error_;
    bool zeros_ = false, infinities_ = false;
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
