// SPDX-License-Identifier: MIT
// How time and memory of each path grow with one thing at a time: --table growth.
#pragma once

#include "compare/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace diptych::bench {

// One path along one axis.
struct GrowthLine {
    GrowthAxis axis;
    Path path;
    std::vector<const BenchRow*> rows;  // ascending
};

// Where a line grows most: from `value` to `until` as the power `exponent` of what grows (1 is in
// proportion), in every step by more than its square root. Not found where no step does.
struct Bend {
    double value = 0, until = 0;
    double exponent = 0;
    bool found = false;
};

// In the order of the rows; they refer to these.
std::vector<GrowthLine> growthLines(const Bench& bench);

// `values` ascending, `amounts` above 0, as many. Throws std::logic_error where they are not.
Bend bendOf(const std::vector<double>& values, const std::vector<double>& amounts);

// The whole memory that a row's frame and scene take on the device, MiB.
double memoryMib(const BenchRow& row);

// A sentence a line and figure: where it bends, how it grows from there, and the pass that most of it is.
std::vector<std::string> growthInWords(const Bench& bench);

std::string growthText(const Bench& bench);
std::string growthHtml(const Bench& bench);
nlohmann::ordered_json growthJson(const Bench& bench);
// A panel of time and one of memory for each axis, both of logarithmic axes; a line a path.
std::string growthPlot(const Bench& bench, PlotPlace place);

}  // namespace diptych::bench
