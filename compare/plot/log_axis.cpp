// SPDX-License-Identifier: MIT
#include "compare/plot/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace diptych {
namespace {

// "0.02", "500", "2e-5".
std::string textOf(double value) {
    if (value >= 1e-3 && value < 1e5) return fmt::format("{:.6g}", value);
    const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    return fmt::format("{:.3g}e{}", value / std::pow(10.0, exponent), exponent);
}

}  // namespace

LogAxis::LogAxis(const std::vector<double>& values) {
    double least = 0, most = 0;
    for (const double value : values) {
        if (!(value > 0) || !std::isfinite(value)) continue;
        const double v = std::clamp(value, 1e-100, 1e100);  // keeps ends and ratio finite
        least = least == 0 ? v : std::min(least, v);
        most = std::max(most, v);
    }
    if (most == 0) return;
    const double margin = std::max(std::pow(most / least, 0.06), 1.08);
    low_ = least / margin;
    high_ = most * margin;
}

double LogAxis::place(double value) const {
    if (!(value > low_)) return 0;
    return std::clamp(std::log(value / low_) / std::log(high_ / low_), 0.0, 1.0);
}

std::vector<Tick> LogAxis::ticks() const {
    constexpr std::size_t enough = 3;
    const int first = static_cast<int>(std::floor(std::log10(low_))),
              last = static_cast<int>(std::ceil(std::log10(high_)));
    const auto within = [&](std::initializer_list<double> of, bool minor) {
        std::vector<Tick> ticks;
        for (int e = first; e <= last; ++e)
            for (const double m : of)
                if (const double v = m * std::pow(10.0, e); v >= low_ && v <= high_)
                    ticks.push_back({v, minor ? "" : textOf(v)});
        return ticks;
    };
    if (std::vector<Tick> decades = within({1}, false); decades.size() >= 2) {
        // Over many decades every second or third is labelled.
        const std::size_t step = (decades.size() + 5) / 6;
        for (std::size_t i = 0; i < decades.size(); ++i)
            if (i % step != 0) decades[i].text.clear();
        if (decades.size() <= 4)
            for (Tick& tick : within({2, 3, 4, 5, 6, 7, 8, 9}, true)) decades.push_back(tick);
        return decades;
    }
    if (std::vector<Tick> ticks = within({1, 2, 5}, false); ticks.size() >= enough) return ticks;
    if (std::vector<Tick> ticks = within({1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}, false); ticks.size() >= enough)
        return ticks;
    // Less than a factor of two: even steps of 1, 2 or 5.
    const double rough = (high_ - low_) / 5, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough / power < 1.5   ? 1
                                 : rough / power < 3.5 ? 2
                                 : rough / power < 7.5 ? 5
                                                       : 10);
    std::vector<Tick> ticks;
    for (double n = std::ceil(low_ / step); n * step <= high_; ++n)
        ticks.push_back({n * step, fmt::format("{:.6g}", n * step)});
    return ticks;
}

}  // namespace diptych
