// SPDX-License-Identifier: MIT
// Exact order statistics without sorting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace diptych::metrics {

// Order statistics of floats that are 0 or above, infinity included; a NaN or a negative value is left out.
// The bits of such floats have the order of their values, so that two histograms of 2^15 and 2^16 bins find
// any rank. Each query reads the values again, which must outlive this object. Results do not depend on the
// number of threads.
class Order {
public:
    // Calls use() with the values [from, to) in their order, in one or several pieces. Called by several
    // threads at once, and again for each query, so that values need not be in memory at the same time.
    using Use = std::function<void(std::span<const float>)>;
    using Values = std::function<void(std::size_t from, std::size_t to, const Use& use)>;
    Order(std::size_t count, Values values);
    explicit Order(std::span<const float> values);

    std::uint64_t size() const { return size_; }
    double sum() const { return sum_; }
    double mean() const { return size_ ? sum_ / static_cast<double>(size_) : 0; }

    // The ceil(share N)-th smallest value (nearest rank), share in [0, 1]; share 0 is the smallest. 0 if
    // there are no values.
    float nearestRank(double share) const { return nearestRanks({&share, 1}).front(); }
    std::vector<float> nearestRanks(std::span<const double> shares) const;  // by one look at the values
    // A quantile in which each value is weighted by itself: the least value such that it and those below it
    // are at least `share` of the sum. 0 if the sum is 0; the sum must be finite.
    float weightedQuantile(double share) const;

private:
    using Bin = std::vector<std::uint32_t>;
    std::vector<Bin> within(const std::vector<std::size_t>& bins) const;  // of each, by the low 16 bits

    std::size_t length_;  // of the values, those that are left out too
    Values values_;
    std::vector<std::uint64_t> count_;  // by the high bits
    std::vector<double> weight_;
    std::uint64_t size_ = 0;
    double sum_ = 0;
};

}  // namespace diptych::metrics
