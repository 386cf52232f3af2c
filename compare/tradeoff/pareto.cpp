// SPDX-License-Identifier: MIT
#include "compare/tradeoff/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace diptych::tradeoff {

std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].time) && std::isfinite(points[i].error)) order.push_back(i);
    std::ranges::sort(order, {},
                      [&](std::size_t i) { return std::tuple(points[i].time, points[i].error, i); });
    // By time, of equal times the smallest error first: what comes later must have less error, or be the
    // same.
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        const bool beats = front.empty() || points[i].error < points[front.back()].error;
        const bool ties = !front.empty() && points[i].error == points[front.back()].error &&
                          points[i].time == points[front.back()].time;
        if (beats || ties) front.push_back(i);
    }
    return front;
}

}  // namespace diptych::tradeoff
