// SPDX-License-Identifier: MIT
#include "compare/tradeoff/shadow_errors.h"

#include "compare/experiment/errors.h"
#include "compare/verdict/shadow_edges.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace diptych::tradeoff {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double share(std::size_t part, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame) {
    const auto seen = frame.channels.find(Channel::shadow_visibility),
               is = reference.channels.find(Channel::shadow_visibility);
    if (reference.shadow_edge.empty() || seen == frame.channels.end() || is == reference.channels.end() ||
        seen->second.pixels() != is->second.pixels())
        return {};
    const Coverage covered = coverage(reference, reference);
    const Requirements needs;
    const ShadowEdges edges({reference, frame, needs, covered});
    std::size_t away = 0, lit = 0, dark = 0;
    double wrong = 0, leaked = 0, arrives = 0;
    std::vector<double> gaps;
    for (std::size_t i = 0; i < is->second.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const double v{*seen->second.pixel(i)}, r{*is->second.pixel(i)};
        const double e{reference.shadow_edge.pixel(i)[2]};
        wrong += std::abs(v - r) * e;
        leaked += std::max(v - r, 0.0) * e;
        arrives += r * e;
        if (v - r > 0.5)
            gaps.push_back(edges.hasSun() ? edges.distance(i) / edges.reach(i).texel : unbounded);
        if (edges.isNear(i)) continue;
        ++away;
        lit += v > r;
        dark += v < r;
    }
    const auto ofAll = [&](double energy) {
        return arrives > 0 ? energy / arrives : energy > 0 ? unbounded : 0;
    };
    return ShadowErrors{ofAll(wrong), share(lit, away), share(dark, away), ofAll(leaked),
                        experiment::nearestRank(std::move(gaps), 0.99)};
}

}  // namespace diptych::tradeoff
