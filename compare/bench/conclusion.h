// SPDX-License-Identifier: MIT
// Conclusions of a benchmark: which Settings are faster, by how much, how certain, and because of which
// pass.
#pragma once

#include "compare/bench/bench.h"

#include <string>
#include <vector>

namespace diptych::bench {

// Median of paired ratios with a distribution-free confidence interval: order statistics of a sign test
// (Thompson 1936, "On Confidence Ranges for the Median and Other Expectation Distributions for Populations
// of Unknown Distribution Form"; Conover 1999, "Practical Nonparametric Statistics", 3.2). 95 % needs at
// least six pairs.
struct PairedRatio {
    double median = 1, low = 1, high = 1;
    double confidence = 0;  // 0 to 1
    int pairs = 0;
    bool isSure() const { return confidence > 0.9 && (low > 1 || high < 1); }
};
PairedRatio pairedRatio(const std::vector<double>& slower, const std::vector<double>& faster);

// Compares rows with equal size, light count and image: the fastest with the fastest of the other path.
// With only one path, compares it with the next row.
struct Conclusion {
    const BenchRow *faster = nullptr, *slower = nullptr;
    PairedRatio ratio;  // time of the slower over the faster
    // The pass that accounts for most of the difference; empty if none does.
    std::string pass;
    double faster_ms = 0, slower_ms = 0;  // of that pass, ms; 0 if the row lacks it

    std::string inWords() const;  // a sentence
};

// By size and light count, in row order. Single rows have no conclusion.
std::vector<Conclusion> conclusionsOf(const Bench& bench);

}  // namespace diptych::bench
