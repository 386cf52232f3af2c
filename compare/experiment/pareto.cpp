// SPDX-License-Identifier: MIT
#include "compare/experiment/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace diptych::experiment {

std::vector<std::size_t> paretoFront(const std::vector<TimeError>& points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].time) && std::isfinite(points[i].error)) order.push_back(i);
    // By error: a point can only be dominated by earlier ones, which are decided by then.
    std::ranges::sort(order, {},
                      [&](std::size_t i) { return std::tuple(points[i].error, points[i].time, i); });
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        const TimeError& point = points[i];
        const bool beaten = std::ranges::any_of(front, [&](std::size_t other) {
            const TimeError& o = points[other];
            const bool same = o.error == point.error && o.time == point.time;
            return !same && o.time <= point.time + std::max(o.noise, point.noise);
        });
        if (!beaten) front.push_back(i);
    }
    std::ranges::sort(front, {}, [&](std::size_t i) { return std::pair(points[i].time, i); });
    return front;
}

}  // namespace diptych::experiment
