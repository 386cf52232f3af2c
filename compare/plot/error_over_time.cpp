// SPDX-License-Identifier: MIT
#include "compare/plot/error_over_time.h"

#include "compare/page/text.h"
#include "compare/plot/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {

namespace {

constexpr double lane = 26;

constexpr double width = 720, height = 440, left = 74, right = 16, top = 54, bottom = 56;
constexpr double letterWidth = 11.5, letterHeight = 17;  // of labels, at the style's largest text size
constexpr double farLabel = 40;                          // from the point to its label's centre
constexpr PlotBox axesBox{left, top, width - right, height - bottom};

}  // namespace

ErrorOverTime::ErrorOverTime(const PlotBox& box, const std::vector<double>& times,
                             const std::vector<double>& errors, std::span<const double> points)
    : box_(box),
      time_(times),
      error_(errors),
      zeros_(std::ranges::any_of(points, [](double error) { return !(error > 0); })),
      infinities_(std::ranges::any_of(points, [](double error) { return !std::isfinite(error); })) {}

double ErrorOverTime::x(double ms) const {
    return box_.left + time_.place(ms) * (box_.right - box_.left);
}

double ErrorOverTime::y(double error) const {
    const double low = box_.bottom - (zeros_ ? lane : 0), high = box_.top + (infinities_ ? lane : 0);
    if (!(error > 0)) return zeros_ ? box_.bottom - lane / 2 : low;
    if (!std::isfinite(error)) return box_.top + lane / 2;
    return low - error_.place(error) * (low - high);
}

std::string ErrorOverTime::axes(const std::string& error_name) const {
    Drawing drawing;
    drawing.axes(box_, {time_.ticks(), [this](double ms) { return x(ms); }, "time of a frame, ms"},
                 {error_.ticks(), [this](double error) { return y(error); }, error_name});
    if (zeros_) {
        drawing.line("gap", box_.left, box_.bottom - lane, box_.right, box_.bottom - lane);
        drawing.text("tick end", box_.left - 8, y(0) + 4, "0");
    }
    if (infinities_) {
        drawing.line("gap", box_.left, box_.top + lane, box_.right, box_.top + lane);
        drawing.text("tick end", box_.left - 8, box_.top + lane / 2 + 4, "\u221e");
    }
    return drawing.group();
}

std::string ErrorOverTime::front(std::span<const std::pair<double, double>> points) const {
    std::string line;
    for (const auto& [ms, error] : points)
        line += line.empty()
                    ? fmt::format("M{} {}V{}", svgNumber(x(ms)), svgNumber(box_.top), svgNumber(y(error)))
                    : fmt::format("H{}V{}", svgNumber(x(ms)), svgNumber(y(error)));
    if (line.empty()) return {};
    return fmt::format("<path class=\"front\" d=\"{}H{}\"/>", line, svgNumber(box_.right));
}

std::string pathMark(Path path, double x, double y, double r) {
    if (hasGBuffer(path))
        return fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", svgNumber(x),
                           svgNumber(y), svgNumber(r));
    return fmt::format("<rect class=\"mark\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                       svgNumber(x - 0.9 * r), svgNumber(y - 0.9 * r), svgNumber(1.8 * r),
                       svgNumber(1.8 * r));
}

namespace {

std::vector<double> timesOf(const ErrorPlot& plot) {
    std::vector<double> all;
    for (const ErrorPoint& point : plot.points)
        all.insert(all.end(), {point.ms, point.least_ms, point.most_ms});
    if (plot.most_ms) all.push_back(*plot.most_ms);
    return all;
}

std::vector<double> errorsOf(const ErrorPlot& plot) {
    std::vector<double> all;
    for (const ErrorPoint& point : plot.points) {
        all.insert(all.end(), {point.error, point.most_error});
        if (point.error > 0) all.push_back(point.least_error);
    }
    if (plot.most_error) all.push_back(*plot.most_error);
    return all;
}

std::vector<double> ownErrors(const ErrorPlot& plot) {
    std::vector<double> all;
    for (const ErrorPoint& point : plot.points) all.push_back(point.error);
    return all;
}

class Plot {
public:
    Plot(const ErrorPlot& plot, PlotPlace place, const char* role)
        : plot_(plot),
          file_(place == PlotPlace::file),
          role_(role),
          axes_(axesBox, timesOf(plot), errorsOf(plot), ownErrors(plot)) {}

    std::string markup() const {
        std::string out = axes_.axes(plot_.error_name) + limits() + frontLine();
        for (const bool best : {false, true})
            for (const ErrorPoint& point : plot_.points)
                if (point.best == best) out += markOf(point);
        return out + labels() + (plot_.legend ? legend() : "");
    }

private:
    double x(double ms) const { return axes_.x(ms); }
    double y(double error) const { return axes_.y(error); }

    std::string limits() const {
        std::string out;
        const auto line = [&](double x1, double y1, double x2, double y2, const std::string& words) {
            out += fmt::format(
                "<line class=\"budget\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"><title>{}</title></line>",
                svgNumber(x1), svgNumber(y1), svgNumber(x2), svgNumber(y2), page::markup(words));
        };
        if (const auto& most = plot_.most_error)
            line(left, y(*most), width - right, y(*most), fmt::format("at most {:.4g}", *most));
        if (const auto& most = plot_.most_ms)
            line(x(*most), top, x(*most), height - bottom, fmt::format("at most {:.4g} ms", *most));
        return out;
    }

    std::string frontLine() const {
        std::vector<std::pair<double, double>> points;
        for (const ErrorPoint& point : plot_.points)
            if (point.front) points.emplace_back(point.ms, point.error);
        std::ranges::sort(points);
        return axes_.front(points);
    }

    std::string markOf(const ErrorPoint& point) const {
        const double px = x(point.ms), py = y(point.error);
        const std::string words = page::markup(point.words);
        std::string out = fmt::format(
            "<g class=\"point {}{}\" data-row=\"{}\"{}>", nameOf(point.path), point.best ? " best" : "",
            point.number,
            file_ ? "" : fmt::format(" tabindex=\"0\" role=\"{}\" aria-label=\"{}\"", role_, words));
        if (file_ || std::string_view(role_) != "button") out += "<title>" + words + "</title>";
        std::string bar;
        if (point.least_ms < point.ms || point.most_ms > point.ms)
            bar += fmt::format("M{} {}H{}", svgNumber(x(point.least_ms)), svgNumber(py),
                               svgNumber(x(point.most_ms)));
        if (point.least_error < point.error || point.most_error > point.error)
            bar += fmt::format("M{} {}V{}", svgNumber(px), svgNumber(y(point.least_error)),
                               svgNumber(y(point.most_error)));
        if (!bar.empty()) out += fmt::format("<path class=\"bar\" d=\"{}\"/>", bar);
        return out + pathMark(point.path, px, py, point.best ? 6 : 4.5) +
               fmt::format("<circle class=\"hit\" cx=\"{}\" cy=\"{}\" r=\"11\"/></g>", svgNumber(px),
                           svgNumber(py));
    }

    // Above all points. A line connects a label with its point if it is far away or closer to another.
    std::string labels() const {
        std::vector<Label> labels;
        std::vector<std::string> texts;
        std::vector<PlotBox> marks;
        for (const ErrorPoint& point : plot_.points) {
            const double px = x(point.ms), py = y(point.error);
            marks.push_back({px - 5, py - 5, px + 5, py + 5});
            if (point.label.empty()) continue;
            labels.push_back({px, py, letterWidth * static_cast<double>(point.label.size()), letterHeight});
            texts.push_back(point.label);
        }
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
                               svgNumber(places[i].bottom - 3), page::markup(texts[i]));
        }
        return "<g class=\"rows-named\">" + out + "</g>";
    }

    // Above the plot, from the right: what the plot shows.
    std::string legend() const {
        std::string out;
        double px = width - right - 8;
        const double py = 14;
        const auto entry = [&](std::string_view name, std::string_view style, const auto& markAt) {
            px -= 7.5 * static_cast<double>(name.size()) + 32;
            out += fmt::format("<g class=\"point {}\">{}<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text></g>",
                               style, markAt(px), svgNumber(px + 13), svgNumber(py + 5), name);
        };
        const auto line = [&](const char* style) {
            return [=](double at) {
                return fmt::format("<path class=\"{}\" d=\"M{} {}h19\"/>", style, svgNumber(at - 10),
                                   svgNumber(py));
            };
        };
        if (plot_.most_error || plot_.most_ms) entry("limit", "", line("budget"));
        if (!plot_.bar.empty()) entry(plot_.bar, "best", line("bar"));
        for (const auto& [path, name] : enumNames<Path>())
            if (std::ranges::count(plot_.points, path, &ErrorPoint::path) > 0)
                entry(name, name, [&, of = path](double at) { return pathMark(of, at, py, 4.5); });
        return out;
    }

    const ErrorPlot& plot_;
    const bool file_;
    const char* const role_;
    const ErrorOverTime axes_;
};

}  // namespace

std::string errorPlot(const ErrorPlot& plot, PlotPlace place, const char* role) {
    return plotElement(width, height, plot.title, place, Plot(plot, place, role).markup());
}

}  // namespace diptych
