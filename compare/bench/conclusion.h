// SPDX-License-Identifier: MIT
// Conclusions of a benchmark: which Settings are faster, by how much, how certain, and because of which
// pass.
#pragma once

#include "compare/bench/bench.h"
#include "compare/experiment/intervals.h"

#include <string>
#include <vector>

namespace diptych::bench {

using experiment::pairedRatio;
using experiment::TimeRatio;

// Compares rows with equal size, light count and image: the fastest with the fastest of the other path.
// With only one path, compares it with the next row.
struct Conclusion {
    const BenchRow *faster = nullptr, *slower = nullptr;
    TimeRatio ratio;  // time of the slower over the faster
    // The pass that accounts for most of the difference; empty if none does.
    std::string pass;
    double faster_ms = 0, slower_ms = 0;  // of that pass, ms; 0 if the row lacks it

    std::string inWords() const;  // a sentence
};

// By size and light count, in row order. Single rows have no conclusion.
std::vector<Conclusion> conclusionsOf(const Bench& bench);

}  // namespace diptych::bench
