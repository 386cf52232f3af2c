// SPDX-License-Identifier: MIT
// How much of a difference each of its causes is responsible for: Shapley 1953, "A Value for n-Person Games".
// Swapping a cause is worth what it brings on average over all orders in which the causes may be swapped, so
// that shares add up to what swapping all brings, two causes that each do the whole alone share it, and one
// that only makes up for another has a negative share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace diptych {

using Subset = std::uint32_t;  // of the causes, a bit each, the first the lowest

// What swapping the causes of a subset brings. Asked at most once for each subset by the functions below.
using SubsetValue = std::function<double(Subset)>;

constexpr int mostExactCauses = 8;  // 256 subsets
constexpr int mostCauses = 31;

struct Shares {
    double all = 0;             // value of all causes, less that of none
    std::vector<double> share;  // of each cause; they add up to `all`, to rounding
    // Half the 95 % confidence interval of each share; 0: every subset was asked for.
    std::vector<double> interval;
    std::vector<double> alone, last;  // value of each cause alone; what it brings when all others are swapped
    // Of each pair i < j, at place i + j (j - 1) / 2: how much more both bring together than each by itself
    // (the interaction index of Grabisch and Roubens 1999, "An axiomatic approach to the concept of
    // interaction among players in cooperative games"). Negative: one makes the other redundant; positive:
    // one hides what the other does. Empty where shares are sampled.
    std::vector<double> interaction;
    std::size_t asked = 0;  // subsets
};

// Weight of a subset of `size` of the other causes in the share of one of `causes`: how often exactly these
// come before it, |S|! (n - |S| - 1)! / n!.
double shareWeight(int causes, int size);

// The same shares as a linear form of the values, for values that are images: share i is the sum over the
// subsets, which ascend, of weight[i] times the value.
struct SubsetWeights {
    Subset subset = 0;
    std::vector<double> weight;
};
std::vector<SubsetWeights> exactWeights(int causes);
std::vector<SubsetWeights> sampledWeights(int causes, int orders, std::uint64_t seed);

// Every subset once, in ascending order of its bits. Throws std::invalid_argument beyond mostExactCauses.
Shares exactShares(int causes, const SubsetValue& value);

// From `orders` random orders of the causes (Castro, Gomez and Tejada 2009, "Polynomial calculation of the
// Shapley value based on sampling"), each taken backwards too, which cancels much of the deviation; so 2
// orders are one sample of the interval. `orders`: at least 4, even. Throws std::invalid_argument otherwise,
// and beyond mostCauses.
Shares sampledShares(int causes, const SubsetValue& value, int orders, std::uint64_t seed);

}  // namespace diptych
