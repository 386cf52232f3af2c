// SPDX-License-Identifier: MIT
#include "compare/plot/error_over_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {

namespace {

constexpr double lane = 26;

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

}  // namespace diptych
