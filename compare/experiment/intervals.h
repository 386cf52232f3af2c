// SPDX-License-Identifier: MIT
// Confidence intervals of measured times.
#pragma once

#include <span>
#include <vector>

namespace diptych::experiment {

// Student's t quantile: |t| exceeds it with `probability`, 0 to 1. `freedom` is at least 1. Uses the
// finite series of Abramowitz and Stegun, 26.7.3 and 26.7.4.
double studentT(double probability, int freedom);

double meanOf(std::span<const double> values);  // of at least one

// Mean and half-width of its confidence interval (Student 1908, "The Probable Error of a Mean");
// infinite with fewer than two values.
struct MeanInterval {
    double mean = 0, half_width = 0;
};
// `doubted`: 1 - confidence.
MeanInterval meanInterval(std::span<const double> values, double doubted);
// The same for the differences a[i] - b[i]. Values that only one of them has are omitted.
MeanInterval meanDifference(std::span<const double> a, std::span<const double> b, double doubted);

// A time over another, with its confidence interval.
struct TimeRatio {
    double ratio = 1, low = 1, high = 1;
    double confidence = 0;  // 0 to 1
    int pairs = 0;
    bool isSure() const { return confidence > 0.9 && (low > 1 || high < 1); }
    bool isSlower() const { return low > 1; }
};
// Geometric mean of paired ratios; the arguments are logarithms of times.
TimeRatio meanRatio(std::span<const double> logs, std::span<const double> base_logs, double doubted);
// Median of paired ratios with a distribution-free interval: order statistics of a sign test (Thompson 1936,
// "On Confidence Ranges for the Median and Other Expectation Distributions for Populations of Unknown
// Distribution Form"; Conover 1999, "Practical Nonparametric Statistics", 3.2). 95 % needs at least six
// pairs.
TimeRatio pairedRatio(const std::vector<double>& slower, const std::vector<double>& faster);

}  // namespace diptych::experiment
