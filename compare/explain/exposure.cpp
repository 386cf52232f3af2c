// SPDX-License-Identifier: MIT
#include "compare/explain/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace diptych {

namespace {

constexpr double sameFactor = 1e-3;
constexpr double darkest = 1e-3;  // fraction of the mean

}  // namespace

std::optional<double> commonFactor(const Image& lit, const Image& expected) {
    double sum = 0;
    std::size_t finite = 0;
    for (const float value : expected.data)
        if (std::isfinite(value)) sum += std::abs(double{value}), ++finite;
    if (finite == 0 || !(sum > 0)) return {};
    const double least = darkest * sum / static_cast<double>(finite);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lit.data.size(); ++i) {
        const double a = lit.data[i], b = expected.data[i];
        if (std::isfinite(a) && std::isfinite(b) && b > least) ratios.push_back(a / b);
    }
    if (ratios.empty()) return {};
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    const double factor = *middle;
    const auto alike = std::ranges::count_if(
        ratios, [factor](double ratio) { return std::abs(ratio - factor) <= sameFactor * factor; });
    if (!(factor > 0) || 2 * static_cast<std::size_t>(alike) < ratios.size()) return {};
    return factor;
}

std::optional<double> exposureBetween(std::optional<double> baseline, std::optional<double> test) {
    if (!baseline || !test) return {};
    const double factor = *test / *baseline;
    if (std::abs(factor - 1) <= 2 * sameFactor) return {};
    return factor;
}

}  // namespace diptych
