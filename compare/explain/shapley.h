// SPDX-License-Identifier: MIT
// Attributes a difference to its causes: Shapley 1953, "A Value for n-Person Games". A cause's contribution
// is its effect averaged over all orders in which the causes may be swapped, so contributions sum to the
// effect of swapping all. Two causes that each have the whole effect alone share it. A cause that only
// compensates for another has a negative contribution.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace diptych {

using Subset = std::uint32_t;  // a bit per cause, the first is the lowest

// The effect of swapping the causes of a subset.
using SubsetValue = std::function<double(Subset)>;

constexpr int maxExactCauses = 8;  // 256 subsets
constexpr int maxCauses = 31;

struct Contributions {
    double all = 0;                    // value of all causes minus that of none
    std::vector<double> contribution;  // of each cause; they sum to `all`, to rounding
    // Half the 95 % confidence interval of each contribution; 0: exact.
    std::vector<double> interval;
    std::vector<double> alone, last;  // value of each cause alone; effect of swapping it after all others
    // For each pair i < j, at index i + j (j - 1) / 2: their joint effect minus the sum of their effects
    // (the interaction index of Grabisch and Roubens 1999, "An axiomatic approach to the concept of
    // interaction among players in cooperative games"). Negative: one makes the other redundant; positive:
    // one hides the other's effect. Empty if contributions are sampled.
    std::vector<double> interaction;
};

// The same contributions as a linear form, for values that are images: contribution i is the sum over the
// subsets, ascending, of weight[i] times the value.
struct SubsetWeights {
    Subset subset = 0;
    std::vector<double> weight;
};
std::vector<SubsetWeights> exactWeights(int causes);
std::vector<SubsetWeights> sampledWeights(int causes, int orders, std::uint64_t seed);

// Evaluates every subset. Throws std::invalid_argument beyond maxExactCauses.
Contributions exactContributions(int causes, const SubsetValue& value);

// From `orders` random orders of the causes (Castro, Gomez and Tejada 2009, "Polynomial calculation of the
// Shapley value based on sampling"). Each order is also used reversed, which cancels much of the
// deviation, so 2 orders are one sample of the interval. `orders`: even, at least 4. Throws
// std::invalid_argument otherwise, and beyond maxCauses.
Contributions sampledContributions(int causes, const SubsetValue& value, int orders, std::uint64_t seed);

}  // namespace diptych
