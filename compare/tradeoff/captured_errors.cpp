// SPDX-License-Identifier: MIT
#include "compare/tradeoff/captured_errors.h"

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

double fraction(std::size_t part, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame) {
    const Image *seen = findChannel(frame, Channel::shadow_visibility),
                *is = findChannel(reference, Channel::shadow_visibility);
    if (reference.shadow_edge.empty() || !seen || !is || seen->pixels() != is->pixels()) return {};
    const Coverage covered = coverage(reference, reference);
    const Requirements needs;
    const ShadowEdges edges({reference, frame, needs, covered});
    std::size_t away = 0, lit = 0, dark = 0;
    double wrong = 0, leaked = 0, arrives = 0;
    std::vector<double> gaps;
    for (std::size_t i = 0; i < is->pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const double v{*seen->pixel(i)}, r{*is->pixel(i)};
        const double e{reference.shadow_edge.pixel(i)[2]};
        wrong += std::abs(v - r) * e;
        leaked += std::max(v - r, 0.0) * e;
        arrives += r * e;
        if (v - r > 0.5)
            gaps.push_back(edges.hasSun() ? edges.distance(i) / edges.filterRadius(i).texel : unbounded);
        if (edges.isNear(i)) continue;
        ++away;
        lit += v > r;
        dark += v < r;
    }
    const auto ofAll = [&](double energy) {
        return arrives > 0 ? energy / arrives : energy > 0 ? unbounded : 0;
    };
    return ShadowErrors{ofAll(wrong), fraction(lit, away), fraction(dark, away), ofAll(leaked),
                        experiment::nearestRank(std::move(gaps), 0.99)};
}

std::optional<Settings> exactEdges(const Settings& settings) {
    if (!hasGBuffer(settings.path) || settings.msaa == 1) return {};
    Settings exact = settings;
    exact.msaa_edges = MsaaEdges::exact;
    return exact;
}

std::optional<SampleFractions> sampleFractionsOf(const Frame& exact, const Frame& frame) {
    const Image *lit = findChannel(frame, Channel::lit), *exact_lit = findChannel(exact, Channel::lit),
                *shaded = findChannel(frame, Channel::shaded_samples),
                *exact_shaded = findChannel(exact, Channel::shaded_samples);
    if (!lit || !exact_lit || !shaded || !exact_shaded || lit->pixels() != exact_lit->pixels()) return {};
    double pixels = 0, surfaces = 0, edges = 0, differing = 0, elsewhere = 0;
    for (std::size_t i = 0; i < lit->pixels(); ++i) {
        const float count = shaded->pixel(i)[0];
        if (!(count > 0)) continue;
        ++pixels;
        surfaces += double{count};
        edges += count > 1;
        const bool differs = !std::equal(lit->pixel(i), lit->pixel(i) + lit->components, exact_lit->pixel(i));
        differing += differs;
        elsewhere += differs && count >= exact_shaded->pixel(i)[0];
    }
    if (pixels == 0) return SampleFractions{};
    return SampleFractions{surfaces / pixels, edges / pixels, differing / pixels, elsewhere / pixels};
}

}  // namespace diptych::tradeoff
