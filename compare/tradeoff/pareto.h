// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::tradeoff {

struct TimeError {
    double time = 0, error = 0;
};

// The indices of the points that no other point dominates, that is, equals or beats in both values and beats
// in one. Equal points are kept together. Points with a NaN or infinity are never on the front and dominate
// nothing. Sorted by time, then by index.
std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points);

}  // namespace diptych::tradeoff
