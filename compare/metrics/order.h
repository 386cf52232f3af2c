// SPDX-License-Identifier: MIT
// Exact order statistics without sorting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace diptych::metrics {

// Order statistics of non-negative floats, including infinity; ignores NaN and negative values. The bits
// of such floats sort like their values, so two histograms of 2^15 and 2^16 bins find any rank. Each query
// reads the values again, so they must outlive this object. Results do not depend on the number of
// threads.
class Order {
public:
    // Calls use() with the values [from, to) in order, in one or several chunks. Several threads call it
    // concurrently, and again for each query, so values need not be in memory together.
    using Use = std::function<void(std::span<const float>)>;
    using Values = std::function<void(std::size_t from, std::size_t to, const Use& use)>;
    Order(std::size_t count, Values values);
    explicit Order(std::span<const float> values);

    std::uint64_t size() const { return size_; }
    double sum() const { return sum_; }
    double mean() const { return size_ ? sum_ / static_cast<double>(size_) : 0; }

    // The ceil(fraction N)-th smallest value (nearest rank), `fraction` in [0, 1]; for 0 the smallest. 0
    // without values.
    float nearestRank(double fraction) const { return nearestRanks({&fraction, 1}).front(); }
    std::vector<float> nearestRanks(std::span<const double> fractions) const;  // reads the values once
    // A quantile weighted by value: the least value such that all values up to it add up to at least
    // `fraction` of the sum. 0 if the sum is 0; the sum must be finite.
    float weightedQuantile(double fraction) const;

private:
    using Bin = std::vector<std::uint32_t>;
    // Histogram of the low 16 bits, per bin.
    std::vector<Bin> within(const std::vector<std::size_t>& bins) const;

    std::size_t length_;  // number of values, including ignored ones
    Values values_;
    std::vector<std::uint64_t> count_;  // by the high bits
    std::vector<double> weight_;
    std::uint64_t size_ = 0;
    double sum_ = 0;
};

}  // namespace diptych::metrics
