// SPDX-License-Identifier: MIT
#include "compare/experiment/intervals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>

namespace diptych::experiment {

namespace {

constexpr double wantedConfidence = 0.95;  // of pairedRatio()

// P(|T| <= t) of Student's t distribution.
double within(double t, int freedom) {
    const double angle = std::atan(t / std::sqrt(static_cast<double>(freedom)));
    const double c = std::cos(angle), s = std::sin(angle);
    double term = freedom % 2 == 1 ? c : 1, sum = freedom == 1 ? 0 : term;
    for (int k = freedom % 2 == 1 ? 3 : 2; k < freedom; k += 2) {
        term *= c * c * (k - 1) / k;
        sum += term;
    }
    return freedom % 2 == 1 ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

// Probability that the median of n lies between the k-th least and the k-th greatest value: 1 - 2
// P(Binomial(n, 1/2) < k).
double confidenceOf(int n, int k) {
    double below = 0;
    // In log space: 2^-n underflows from about a thousand pairs on.
    for (int i = 0; i < k; ++i)
        below += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) -
                          n * std::numbers::ln2);
    return 1 - 2 * below;
}

}  // namespace

double studentT(double probability, int freedom) {
    double low = 0, high = 1;
    while (within(high, freedom) < 1 - probability && high < 1e12) high *= 2;
    for (int i = 0; i < 100 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        (within(middle, freedom) < 1 - probability ? low : high) = middle;
    }
    return high;
}

double meanOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

MeanInterval meanInterval(std::span<const double> values, double doubted) {
    const double mean = meanOf(values);
    if (values.size() < 2) return {mean, std::numeric_limits<double>::infinity()};
    double squares = 0;
    for (const double each : values) squares += (each - mean) * (each - mean);
    const auto n = static_cast<double>(values.size());
    return {mean, studentT(doubted, static_cast<int>(values.size()) - 1) * std::sqrt(squares / (n - 1) / n)};
}

MeanInterval meanDifference(std::span<const double> a, std::span<const double> b, double doubted) {
    std::vector<double> differences(std::min(a.size(), b.size()));
    for (std::size_t k = 0; k < differences.size(); ++k) differences[k] = a[k] - b[k];
    return meanInterval(differences, doubted);
}

TimeRatio meanRatio(std::span<const double> logs, std::span<const double> base_logs, double doubted) {
    const auto [mean, half_width] = meanDifference(logs, base_logs, doubted);
    return {std::exp(mean), std::exp(mean - half_width), std::exp(mean + half_width), 1 - doubted,
            static_cast<int>(std::min(logs.size(), base_logs.size()))};
}

TimeRatio pairedRatio(const std::vector<double>& slower, const std::vector<double>& faster) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(slower.size(), faster.size()); ++i)
        if (faster[i] > 0) ratios.push_back(slower[i] / faster[i]);
    TimeRatio result;
    result.pairs = static_cast<int>(ratios.size());
    if (ratios.empty()) return result;
    std::ranges::sort(ratios);
    result.ratio = 0.5 * (ratios[(ratios.size() - 1) / 2] + ratios[ratios.size() / 2]);
    int k = 1;
    while (2 * k < result.pairs && confidenceOf(result.pairs, k + 1) >= wantedConfidence) ++k;
    result.confidence = std::max(0.0, confidenceOf(result.pairs, k));
    result.low = ratios[static_cast<std::size_t>(k) - 1];
    result.high = ratios[ratios.size() - static_cast<std::size_t>(k)];
    return result;
}

}  // namespace diptych::experiment
