// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::tradeoff {

// A measured time, what it may be off by, and an error, which repeats exactly.
struct TimeError {
    double time = 0, error = 0, noise = 0;
};

// The indices of the points of least error for their time: each but those for which a point of the front has
// no larger error and is not slower by more than the larger noise of both. So of two points of one error
// whose times noise cannot tell apart the faster one stands there, and a point is not there for the luck of
// its time. Without noise it is the Pareto front, of points that no other one equals or beats in both values
// and beats in one. Points equal in both stay together. Points with a NaN or infinity are never on the front
// and keep no other one from it. Sorted by time, then by index.
std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points);

}  // namespace diptych::tradeoff
