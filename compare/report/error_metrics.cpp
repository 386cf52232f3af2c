// SPDX-License-Identifier: MIT
#include "compare/report/error_metrics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych {
namespace {

constexpr int maxDecades = 12;
constexpr int wantedBins = 48;

// The smallest and largest covered errors that are finite and above 0; {0, 0} if there are none.
std::pair<double, double> rangeOf(const Image& errors, const Coverage& coverage) {
    double low = HUGE_VAL, high = 0;
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        const double e = errors.data[i];
        if (!coverage.covered[i] || !(e > 0) || !std::isfinite(e)) continue;
        low = std::min(low, e);
        high = std::max(high, e);
    }
    return high > 0 ? std::pair{low, high} : std::pair{0.0, 0.0};
}

}  // namespace

double ErrorHistogram::edge(std::size_t bin) const {
    return std::pow(10.0, first_decade + static_cast<double>(bin) / bins_per_decade);
}

ErrorHistogram errorHistogram(const Image& errors, const Coverage& coverage) {
    ErrorHistogram histogram;
    const auto [low, high] = rangeOf(errors, coverage);
    double first = 0;
    if (high > 0) {
        const int last = static_cast<int>(std::ceil(std::log10(high)));
        histogram.first_decade =
            std::clamp(static_cast<int>(std::floor(std::log10(low))), last - maxDecades, last - 1);
        const int decades = last - histogram.first_decade;
        histogram.bins_per_decade = std::clamp(wantedBins / decades, 4, 24);
        histogram.bins.resize(static_cast<std::size_t>(decades * histogram.bins_per_decade));
        first = histogram.edge(0);
    }
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        if (!coverage.covered[i]) continue;
        const double e = errors.data[i];
        if (e == 0) {
            ++histogram.equal;
        } else if (!std::isfinite(e)) {
            ++histogram.infinite;
        } else {
            const double at = (std::log10(e) - histogram.first_decade) * histogram.bins_per_decade;
            ++histogram.bins[static_cast<std::size_t>(
                std::clamp(std::floor(at), 0.0, static_cast<double>(histogram.bins.size() - 1)))];
            histogram.smaller += e < first;
        }
    }
    return histogram;
}

std::vector<WorstPixel> worstPixels(const Image& errors, std::size_t max, int spacing, int first_x,
                                    int first_y) {
    PixelData left = errors.data;
    std::vector<WorstPixel> worst;
    const auto take = [&](int x, int y) {
        worst.push_back({x, y, double{errors.at(x, y)}});
        for (int v = std::max(y - spacing + 1, 0); v < std::min(y + spacing, errors.height); ++v)
            for (int u = std::max(x - spacing + 1, 0); u < std::min(x + spacing, errors.width); ++u)
                left[static_cast<std::size_t>(v) * static_cast<std::size_t>(errors.width) +
                     static_cast<std::size_t>(u)] = 0;
    };
    if (max > 0 && first_x >= 0 && first_y >= 0 && errors.at(first_x, first_y) > 0) take(first_x, first_y);
    while (worst.size() < max) {
        const auto largest = std::ranges::max_element(left);
        if (largest == left.end() || !(*largest > 0)) break;
        const auto i = static_cast<int>(largest - left.begin());
        take(i % errors.width, i / errors.width);
    }
    return worst;
}

}  // namespace diptych
