// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::experiment {

// A measured time, its noise, and a deterministic error.
struct TimeError {
    double time = 0, error = 0, noise = 0;
};

// Indices of the Pareto front with noisy times, sorted by time, then index. A point of the front dominates
// another if its error is not larger and it is not slower by more than the larger noise of both. So among
// equal errors with indistinguishable times the fastest remains, and luck in timing puts no point on the
// front. Without noise this is the usual front. Points equal in both values stay together. Points with NaN
// or infinity are ignored.
std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points);

}  // namespace diptych::experiment
