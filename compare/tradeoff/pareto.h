// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::tradeoff {

struct TimeError {
    double time = 0, error = 0;
};

// Which points no other one beats: none is as good in both and better in one. Equal points stay together, so
// that a tie is seen; a NaN or infinity is never on the front and beats nothing. By time, then by number.
std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points);

}  // namespace diptych::tradeoff
