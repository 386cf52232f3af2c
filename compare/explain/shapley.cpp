// SPDX-License-Identifier: MIT
#include "compare/explain/shapley.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

std::size_t indexOfCause(int causes) {
    return static_cast<std::size_t>(causes);
}

Subset allOf(int causes) {
    return causes == 0 ? 0 : ~Subset{0} >> (32 - causes);
}

double factorial(int n) {
    return std::tgamma(n + 1.0);
}

// Weight of a subset of `size` other causes in one cause's contribution: the probability that exactly these
// precede it, |S|! (n - |S| - 1)! / n!.
double contributionWeight(int causes, int size) {
    return factorial(size) * factorial(causes - size - 1) / factorial(causes);
}

Subset countOfSubsets(int causes) {
    if (causes < 0 || causes > maxExactCauses)
        throw std::invalid_argument("exact shares are of at most 8 causes");
    return Subset{1} << causes;
}

// The orders of sampledContributions(), each followed by its reverse.
std::vector<std::vector<int>> sampledOrders(int causes, int orders, std::uint64_t seed) {
    if (causes < 1 || causes > maxCauses || orders < 4 || orders % 2 != 0)
        throw std::invalid_argument(
            "shares are sampled of 1 to 31 causes, by 4 orders or more, an even number");
    std::mt19937_64 random(seed);
    std::vector<int> order(indexOfCause(causes));
    std::iota(order.begin(), order.end(), 0);
    std::vector<std::vector<int>> all;
    for (int sample = 0; sample < orders / 2; ++sample) {
        // Fisher-Yates shuffle; the result of std::shuffle depends on the library.
        for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
        all.push_back(order);
        all.emplace_back(order.rbegin(), order.rend());
    }
    return all;
}

void addExtremes(Contributions& contributions, int causes, const SubsetValue& value) {
    const Subset all = allOf(causes);
    const double none = value(0), whole = value(all);
    contributions.all = whole - none;
    for (int i = 0; i < causes; ++i) {
        const Subset one = Subset{1} << i;
        contributions.alone.push_back(value(one) - none);
        contributions.last.push_back(whole - value(all & ~one));
    }
}

}  // namespace

Contributions exactContributions(int causes, const SubsetValue& value) {
    const Subset end = countOfSubsets(causes);
    Contributions contributions;
    contributions.contribution.resize(indexOfCause(causes));
    contributions.interval.resize(indexOfCause(causes));
    addExtremes(contributions, causes, value);
    for (Subset subset = 0; subset < end; ++subset)
        for (int i = 0; i < causes; ++i) {
            const Subset one = Subset{1} << i;
            if ((subset & one) != 0) continue;
            contributions.contribution[indexOfCause(i)] +=
                contributionWeight(causes, std::popcount(subset)) * (value(subset | one) - value(subset));
        }
    for (int j = 1; j < causes; ++j)
        for (int i = 0; i < j; ++i) {
            const Subset a = Subset{1} << i, b = Subset{1} << j;
            double sum = 0;
            for (Subset subset = 0; subset < end; ++subset)
                if ((subset & (a | b)) == 0)
                    sum += contributionWeight(causes - 1, std::popcount(subset)) *
                           (value(subset | a | b) - value(subset | a) - value(subset | b) + value(subset));
            contributions.interaction.push_back(sum);
        }
    return contributions;
}

std::vector<SubsetWeights> exactWeights(int causes) {
    std::vector<SubsetWeights> all;
    for (Subset subset = 0, end = countOfSubsets(causes); subset < end; ++subset) {
        const int size = std::popcount(subset);
        SubsetWeights& weights = all.emplace_back(SubsetWeights{subset, {}});
        for (int i = 0; i < causes; ++i)
            weights.weight.push_back((subset >> i & 1) != 0 ? contributionWeight(causes, size - 1)
                                                            : -contributionWeight(causes, size));
    }
    return all;
}

std::vector<SubsetWeights> sampledWeights(int causes, int orders, std::uint64_t seed) {
    std::map<Subset, std::vector<double>> weights;
    const auto at = [&](Subset subset) -> std::vector<double>& {
        return weights.try_emplace(subset, indexOfCause(causes)).first->second;
    };
    for (const std::vector<int>& order : sampledOrders(causes, orders, seed)) {
        Subset swapped = 0;
        for (const int i : order) {
            at(swapped)[indexOfCause(i)] -= 1.0 / orders;
            swapped |= Subset{1} << i;
            at(swapped)[indexOfCause(i)] += 1.0 / orders;
        }
    }
    // Each cause alone and all others, which may not have been evaluated yet.
    for (int i = 0; i < causes; ++i) {
        at(Subset{1} << i);
        at(allOf(causes) & ~(Subset{1} << i));
    }
    std::vector<SubsetWeights> all;
    for (auto& [subset, weight] : weights) all.push_back({subset, std::move(weight)});
    return all;
}

Contributions sampledContributions(int causes, const SubsetValue& value, int orders, std::uint64_t seed) {
    const std::vector<std::vector<int>> all = sampledOrders(causes, orders, seed);
    std::vector<double> sum(indexOfCause(causes)), squares(indexOfCause(causes)), one(indexOfCause(causes));
    const int samples = orders / 2;
    for (std::size_t at = 0; at < all.size(); at += 2) {
        std::fill(one.begin(), one.end(), 0.0);
        for (const std::vector<int>& order : {all[at], all[at + 1]}) {
            Subset swapped = 0;
            for (const int i : order) {
                const Subset more = swapped | Subset{1} << i;
                one[indexOfCause(i)] += 0.5 * (value(more) - value(swapped));
                swapped = more;
            }
        }
        for (std::size_t i = 0; i < one.size(); ++i) {
            sum[i] += one[i];
            squares[i] += one[i] * one[i];
        }
    }
    Contributions contributions;
    // The 97.5 % point of Student's t, accurate to 2 % from 4 degrees of freedom on (expansion about the
    // normal distribution: Abramowitz and Stegun 26.7.5).
    const double freedom = samples - 1, student = 1.96 + 2.37 / freedom + 2.8 / (freedom * freedom);
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double mean = sum[i] / samples;
        const double variance = std::max(0.0, squares[i] / samples - mean * mean) / (samples - 1);
        contributions.contribution.push_back(mean);
        contributions.interval.push_back(student * std::sqrt(variance));
    }
    addExtremes(contributions, causes, value);
    return contributions;
}

}  // namespace diptych
