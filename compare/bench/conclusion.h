// SPDX-License-Identifier: MIT
// What a benchmark says: which Settings are faster, by how much, how sure that is, and what decides it.
#pragma once

#include "compare/bench/bench.h"

#include <string>
#include <vector>

namespace diptych::bench {

// The median of paired ratios, with an interval that holds the true median with at least `confidence`
// whatever their distribution is: the order statistics of a sign test (Thompson 1936, "On Confidence Ranges
// for the Median and Other Expectation Distributions for Populations of Unknown Distribution Form"; Conover
// 1999, "Practical Nonparametric Statistics", 3.2). No fewer than six pairs reach 95 %.
struct PairedRatio {
    double median = 1, low = 1, high = 1;
    double confidence = 0;  // 0 to 1
    int pairs = 0;
    bool isSure() const { return confidence > 0.9 && (low > 1 || high < 1); }
};
PairedRatio pairedRatio(const std::vector<double>& slower, const std::vector<double>& faster);

// Of the rows of one size and light count that draw the same picture: the fastest beside the fastest of the
// other path, or, of one path alone, beside the next.
struct Conclusion {
    const BenchRow *faster = nullptr, *slower = nullptr;
    PairedRatio ratio;  // how many times as long the slower one takes
    // The pass whose time tells them apart most, in the direction of the whole; empty if none does.
    std::string pass;
    double faster_ms = 0, slower_ms = 0;  // of that pass; 0 where a row has none of that name

    std::string inWords() const;  // a sentence
};

// By size and light count, in the order of the rows; nothing for those with a single row.
std::vector<Conclusion> conclusionsOf(const Bench& bench);

}  // namespace diptych::bench
