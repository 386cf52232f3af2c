// SPDX-License-Identifier: MIT
// Growth of time and memory of each path with one quantity: --table growth.
#pragma once

#include "compare/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace diptych::bench {

// One path on one axis.
struct GrowthLine {
    GrowthAxis axis;
    Path path;
    std::vector<const BenchRow*> rows;  // ascending
};

// The range with the largest growth: amount ~ quantity^exponent from `value` to `until`. Every step in the
// range grows at least as the square root. Not found if no step does.
struct Bend {
    double value = 0, until = 0;
    double exponent = 0;
    bool found = false;
};

// In row order; points into the rows of `bench`.
std::vector<GrowthLine> growthLines(const Bench& bench);

// `values` ascend, `amounts` are positive. Throws std::logic_error if their counts differ.
Bend bendOf(const std::vector<double>& values, const std::vector<double>& amounts);

// Device memory of a row's frame and scene, MiB.
double memoryMib(const BenchRow& row);

// One sentence per line and metric: where growth starts, its exponent, and the pass that causes most of
// it.
std::vector<std::string> growthInWords(const Bench& bench);

std::string growthText(const Bench& bench);
std::vector<output::Block> growthBlocks(const Bench& bench);  // of the page
nlohmann::ordered_json growthJson(const Bench& bench);
// Log-log panels of time and memory per axis, a line per path.
std::string growthPlot(const Bench& bench, PlotPlace place);

}  // namespace diptych::bench
