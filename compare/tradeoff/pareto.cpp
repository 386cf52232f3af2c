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
    // Points are sorted by time and then by error, so a later point is on the front if its error is smaller,
    // or if it equals the last point of the front.
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
