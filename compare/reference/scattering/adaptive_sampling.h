// SPDX-License-Identifier: MIT
// Adaptive sampling: doubles the number of samples until a given confidence is reached.
#pragma once

#include "compare/reference/scattering/sampling.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace diptych::reference {

// Sampling stops when half the 95 % confidence interval is at most samplingError relative to the estimate,
// or at maxSamples. The pixel's uncertainty records which was reached. If no sample sees a light, the
// uncertainty is 0, although up to samplingError of the light may pass through a gap between samples.
inline constexpr double samplingError = 0.01;
inline constexpr std::uint32_t maxSamples = 65536;

struct Estimated {
    Reflected value;
    double uncertainty;  // half the 95 % confidence interval of value.size()
};

// Makes eight independent estimates, estimate(round, index), and doubles their number of samples until
// their means agree. `whole`: the confidence is relative to it if the mean is smaller. `piece`: the
// largest contribution of one sample. If N samples all agree, the contribution they missed is, with 95 %
// confidence, less than 3 / N of it (Hanley and Lippman-Hand 1983, "If Nothing Goes Wrong, Is Everything
// All Right?").
template <class Estimate>
Estimated sampleUntilConfident(const Estimate& estimate, std::size_t samples, std::uint64_t first,
                               double whole, double piece) {
    constexpr std::size_t count = 8;
    // Stopping at the first agreement is biased toward stopping too early: only 92 % of Student's 95 %
    // intervals would contain the true value. With this factor 95 % do.
    constexpr double caution = 1.2;
    std::array<Reflected, count> sums;
    std::uint64_t done = 0;
    for (std::uint64_t next = first;; next *= 2) {
        Rounds rounds;
        for (std::size_t round = 0; round < count; ++round) {
            for (std::uint64_t index = done; index < next; ++index) sums[round] += estimate(round, index);
            rounds.add(sums[round] * (1.0 / static_cast<double>(next)));
        }
        done = next;
        const double size = rounds.mean().size(), width = caution * rounds.halfWidth();
        const double unseen = 3 * piece / static_cast<double>(done * count);
        if (std::max(width, unseen) <= samplingError * std::max(whole, size) ||
            done * count * samples >= maxSamples)
            return {rounds.mean(), size > 0 ? std::max(width, unseen) : width};
    }
}

}  // namespace diptych::reference
