// SPDX-License-Identifier: MIT
// Estimates by samples whose number is doubled until a stated confidence is reached.
#pragma once

#include "compare/reference/sampling.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace diptych::reference {

// Sampling goes on until half the 95 % confidence interval is at most samplingError, relative to what is
// sampled, or until mostSamples; the pixel's uncertainty tells what was reached. If no sample sees a light,
// no uncertainty is stated: less than samplingError of the light may pass through a gap between the samples.
inline constexpr double samplingError = 0.01;
inline constexpr std::uint32_t mostSamples = 65536;

struct Estimated {
    Reflected value;
    double uncertainty;  // half the 95 % confidence interval of value.size()
};

// Eight independent estimates (estimate(round, index)), whose number of samples is doubled until their means
// agree. `whole`: what the confidence is relative to if the mean is smaller. `piece`: the largest
// contribution of one sample; if N samples all agree, what they may have missed is, with 95 % confidence,
// less than 3 / N of it (Hanley and Lippman-Hand 1983, "If Nothing Goes Wrong, Is Everything All Right?").
template <class Estimate>
Estimated untilConfident(const Estimate& estimate, std::size_t samples, std::uint64_t first, double whole,
                         double piece) {
    constexpr std::size_t count = 8;
    // Stopping as soon as the rounds agree is biased towards stopping too early: of intervals by Student's
    // 95 %, only 92 % would contain the true value; with this factor, 95 % do.
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
            done * count * samples >= mostSamples)
            return {rounds.mean(), size > 0 ? std::max(width, unseen) : width};
    }
}

}  // namespace diptych::reference
