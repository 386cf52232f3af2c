// SPDX-License-Identifier: MIT
#include "compare/plot/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

constexpr double laneWidth = 26, lineHeight = 22;

// "0.02", "500", "2e-5".
std::string textOf(double value) {
    const double size = std::abs(value);
    if (size == 0 || (size >= 1e-3 && size < 1e4)) return fmt::format("{:.6g}", value);
    const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
    return fmt::format("{:.6g}e{}", value / std::pow(10.0, exponent), exponent);
}

std::ptrdiff_t namesOf(const std::vector<PlotTick>& ticks) {
    return std::ranges::count_if(ticks, [](const PlotTick& tick) { return !tick.text.empty(); });
}

}  // namespace

Axis::Axis(const PlotAxis& axis, const std::vector<double>& points, const std::vector<double>& others,
           double begin, double end, bool up)
    : categories_(axis.categories),
      logarithmic_(axis.logarithmic && axis.categories.empty()),
      up_(up),
      begin_(begin),
      end_(end) {
    for (const double value : points) {
        const bool zero = logarithmic_ && value <= 0;
        zeros_ |= zero;
        infinities_ |= !zero && !std::isfinite(value);
        nans_ |= std::isnan(value);
    }
    const double lane = std::copysign(laneWidth, end - begin);
    first_ = begin + (zeros_ ? lane : 0);
    last_ = end - (infinities_ ? lane : 0);
    std::vector<double> shown;
    for (const std::vector<double>* values : {&points, &others, &axis.shown})
        for (const double value : *values)
            if (std::isfinite(value) && (!logarithmic_ || value > 0))  // clamped: ends and ratio stay finite
                shown.push_back(std::clamp(value, logarithmic_ ? 1e-100 : -1e100, 1e100));
    if (!categories_.empty())
        shown = {-0.5, static_cast<double>(categories_.size()) - 0.5};
    else if (!logarithmic_)
        shown.push_back(0);
    if (shown.empty()) return;
    const auto [min, max] = std::ranges::minmax(shown);
    const double margin = logarithmic_ ? std::max(std::pow(max / min, 0.06), 1.08) : 1;
    low_ = min / margin;
    high_ = logarithmic_ || max - min > 1e-100 ? max * margin : min + 1;
}

double Axis::at(double value) const {
    if (logarithmic_ && value <= 0) return (begin_ + first_) / 2;
    if (!std::isfinite(value)) return (last_ + end_) / 2;
    const double fraction =
        logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
    return first_ + std::clamp(fraction, 0.0, 1.0) * (last_ - first_);
}

void Axis::add(std::vector<PlotTick>& ticks, double value, const std::string& text) const {
    const double position = at(value);
    const bool named = std::ranges::none_of(ticks, [&](const PlotTick& other) {
        const double width = plotLetter * (0.5 * static_cast<double>(text.size() + other.text.size()) + 0.7);
        return !other.text.empty() && std::abs(other.at - position) < (up_ ? lineHeight : width);
    });
    ticks.push_back({position, named ? text : "", named && !text.empty() ? "grid" : "minor", position});
}

void Axis::addEven(std::vector<PlotTick>& ticks) const {
    const double rough = (high_ - low_) / 6, power = std::pow(10.0, std::floor(std::log10(rough))),
                 fraction = rough / power,
                 step = power * (fraction <= 1   ? 1
                                 : fraction <= 2 ? 2
                                 : fraction <= 5 ? 5
                                                 : 10);
    for (double n = std::ceil(low_ / step); n * step <= high_; ++n) add(ticks, n * step, textOf(n * step));
}

void Axis::addDecades(std::vector<PlotTick>& ticks) const {
    const std::vector<double> levels[] = {{1}, {2, 5}, {3, 4, 6, 7, 8, 9}};
    for (const std::vector<double>& multiples : levels) {
        const bool enough = namesOf(ticks) >= (high_ < 10 * low_ ? 3 : 2);
        if (enough && high_ > 1e4 * low_) return;  // minor ticks would be dense
        for (double exponent = std::floor(std::log10(low_)); exponent <= std::log10(high_); ++exponent)
            for (const double multiple : multiples)
                if (const double v = multiple * std::pow(10.0, exponent); v >= low_ && v <= high_)
                    add(ticks, v, enough ? "" : textOf(v));
    }
}

std::vector<PlotTick> Axis::ticks() const {
    std::vector<PlotTick> ticks;
    for (std::size_t i = 0; i < categories_.size(); ++i) add(ticks, static_cast<double>(i), categories_[i]);
    if (logarithmic_) addDecades(ticks);
    if (categories_.empty() && (!logarithmic_ || (namesOf(ticks) < 3 && high_ < 10 * low_))) {
        ticks.clear();
        addEven(ticks);
    }
    if (zeros_) ticks.push_back({(begin_ + first_) / 2, "0", "gap", first_});
    if (infinities_) ticks.push_back({(last_ + end_) / 2, nans_ ? "\u221e/NaN" : "\u221e", "gap", last_});
    return ticks;
}

}  // namespace diptych
